// SPDX-License-Identifier: BSD-3-Clause
// The direction of a theta function whose zero may come arbitrarily near to the real axis: the angle of a complex
// function of time that is doubly periodic up to a factor, as those of a heavy symmetric top are.
// Sources: NIST Digital Library of Mathematical Functions, sections 20.2 (series) and 20.7(viii) (imaginary
// transformation); Whittaker & Watson, A Course of Modern Analysis, section 22.74, for the integrals of the third kind.
#pragma once

#include <array>

namespace polhode::inline core::inline exact {

/// arg ϑ1(π(u − iβ)/2K, nome exp(−πK'/K)) for real u and a fixed β in [0, K']. The zero is at u = iβ. Both parts keep
/// their own digits near it, so that |z| times this direction is smooth where z goes through or near zero.
/// It carries the circular integrals of the third kind: where |z|² ~ sc²(β | m_c) + sn² u, and, with u − K for u here,
/// where |z|² ~ m_c sd²(β | m_c) + cn² u, the angle of z is ± that of this function plus a constant rate.
class ThetaZeroDirection {
 public:
  /// exp(i turn) times a number of length 1.
  struct Values {
    double turn, re, im;
  };

  /// No zero anywhere: the direction is 1.
  ThetaZeroDirection() = default;

  /// m and m_c = 1 − m each with its own digits; m > 0.
  ThetaZeroDirection(double m, double m_c, double beta);

  Values operator()(double u) const;

  /// The derivative of the angle with respect to u at u = K, farthest from the zero.
  double slope_at_k() const { return slope_at_k_; }

 private:
  // The series is in the nome q = exp(−πK'/K) while K < K', else in p = exp(−πK/K') after Jacobi's imaginary
  // transformation: the first term left out is below exp(−16π) of the first.
  static constexpr int terms = 4;
  bool constant_ = true, transformed_ = false;
  double half_period_ = 0;  // K
  double frequency_ = 0;    // π/2K, transformed: π/2K'
  double turn_ = 0;         // turn per unit of u
  double slope_at_k_ = 0;
  std::array<double, terms> re_{}, im_{};
};

}  // namespace polhode::core::exact
