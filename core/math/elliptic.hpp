// SPDX-License-Identifier: BSD-3-Clause
// Elliptic integrals and functions of Jacobi by the complementary parameter m_c = 1 − m = 1 − k², which keeps its
// digits where the period grows without bound (m_c → 0); K = K(m), K' = K(m_c).
// Sources: NIST Digital Library of Mathematical Functions, chapters 19, 20 and 22; Bulirsch, Numerische Mathematik 7
// (1965) 78–90 (sn, cn, dn); Carlson, Numerical Algorithms 10 (1995) 13–26 (R_F).
#pragma once

#include <array>
#include <concepts>
#include <limits>

#include "core/math/lanes.hpp"

namespace polhode::inline core::inline math {

/// The complete integral K(m) = ∫ dθ/√(1 − m sin²θ) over [0, π/2], for 0 ≤ m_c ≤ 1; infinite at m_c = 0.
double elliptic_k(double m_c);

/// The incomplete integral F(φ | m) for 0 ≤ m_c ≤ 1, φ = atan2(sine, cosine) in [−π, π]; `sine` and `cosine` may have
/// any common factor. The cosine carries the digits near φ = π/2, where F grows like log(1/√m_c).
double elliptic_f(double sine, double cosine, double m_c);

/// The same integral for any phase φ (rad).
double elliptic_f(double phi, double m_c);

/// sn, cn and dn of any real u for one 0 ≤ m_c ≤ 1; at m_c = 0 they are tanh, sech, sech. S: double, or Lanes with an
/// m_c > 0 of its own in each lane.
template <class S>
class JacobiEllipticOf {
 public:
  struct Values {
    S sn, cn, dn;
  };

  JacobiEllipticOf() = default;  ///< m_c = 0
  explicit JacobiEllipticOf(double m_c) requires std::same_as<S, double>;

  /// Gives a lane the function `one`.
  void set(int lane, const JacobiEllipticOf<double>& one) requires is_lanes<S>;

  /// Costs one sine, one cosine and two divisions per level: about 0.1 µs.
  Values operator()(S u) const;

  /// The complete integral K(m); +inf at m_c = 0.
  S quarter_period() const { return quarter_period_; }

 private:
  template <class>
  friend class JacobiEllipticOf;
  static constexpr int max_levels = 16;  // the smallest double m_c needs 12
  int most_levels_ = 0;                  // largest number of levels in a lane; 0: m_c = 0
  S levels_{0.0};
  std::array<S, max_levels> arithmetic_{}, geometric_{};
  S mean_{0.0};
  S quarter_period_{std::numeric_limits<double>::infinity()};
};
using JacobiElliptic = JacobiEllipticOf<double>;

/// The direction in the complex plane of θ(u) = ϑ4(π(u + iβ)/2K, nome exp(−2πK'/K)), for real u and a fixed β in
/// [0, K']. It carries an integral of the third kind without loss of digits: with c = cn(β | m_c)/dn(β | m_c),
///   ∫ du/(1 + c dn u) = const · u − 2c/√((1 − c²)(1 − m_c c²)) · arg θ(u) + const;
/// arg θ is odd and has the period 2K. S: double, or Lanes with a function of its own in each lane.
template <class S>
class ThetaDirectionOf {
 public:
  /// The angle of θ is `turn` + atan2(im, re). No caller needs the arctangent itself.
  struct Values {
    S turn, re, im;
  };

  ThetaDirectionOf() = default;  ///< m = 0
  /// m and m_c = 1 − m are both passed, so that each keeps its own digits.
  ThetaDirectionOf(double m, double m_c, double beta) requires std::same_as<S, double>;

  /// Gives a lane the function `one`. The functions of all lanes must use one series when they are evaluated.
  void set(int lane, const ThetaDirectionOf<double>& one) requires is_lanes<S>;

  Values operator()(S u) const;

  /// The derivative of the angle with respect to u at u = 0.
  S slope_at_zero() const { return slope_at_zero_; }

  /// The series is that of Jacobi's imaginary transformation.
  bool is_transformed() const { return transformed_; }

 private:
  template <class>
  friend class ThetaDirectionOf;
  // The series is in the nome while K < 2K', else in the nome of Jacobi's imaginary transformation; three terms beside
  // the first give full digits in both.
  static constexpr int terms = 3;
  bool transformed_ = false;
  bool constant_ = true;  // m = 0, in all lanes: θ = 1
  S half_period_{0.0};    // K
  S frequency_{0.0};      // π/K, transformed: π/2K'; 0: m = 0
  S turn_{0.0};           // turn per unit of u
  S slope_at_zero_{0.0};
  std::array<S, terms + 1> re_{S(1.0)}, im_{}, nome_power_{};  // nome_power_: p^n
};
using ThetaDirection = ThetaDirectionOf<double>;

}  // namespace polhode::core::math
