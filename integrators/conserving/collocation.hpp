// SPDX-License-Identifier: BSD-3-Clause
// The Gauss methods on the flat ODE ẏ = f(t, y): implicit Runge–Kutta methods of s stages and order 2s,
//   Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),  y' = y + Σ_i d_i Z_i with d = bᵀ A⁻¹,
// additive in the orientation. They are symmetric and keep every quadratic first integral of the flat ODE: |q|² or RᵀR,
// with the body velocity also energy and |IΩ|. Source: Hairer & Wanner, Solving Ordinary Differential Equations II,
// IV.5 and IV.8 (their implementation); Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., IV.2.
//
// The stages are solved by simplified Newton iteration, (1 − h A ⊗ J) ΔZ = residual, to the round-off of the scalar. J
// is a difference quotient, kept from step to step while the iteration contracts by 20 or more, and renewed at the
// stages where it does not contract by 2. There is no limit on h|J|: a linear problem takes one iteration.
#pragma once

#include <Eigen/LU>
#include <cstdint>

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// Compiled once for each scalar (collocation.cpp): it sees the system behind its erased type.
template <class S>
class CollocationSolver {
 public:
  CollocationSolver(const Ode<S>& ode, int stages);

  /// Moves y by h; null, or why it could not.
  const char* step(S t, S h, S* y);
  std::int64_t evaluations() const { return evaluations_; }

 private:
  using Vector = VectorX<S>;
  using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  void rate(S t, const Vector& y, Vector& dy) {
    ode_->rate(t, y.data(), dy.data());
    ++evaluations_;
  }
  void differentiate(S t, const Vector& y);
  void factorise(S h);
  bool solve(S t, S h);

  const Ode<S>* ode_;
  int stages_;
  Matrix a_;
  Vector c_, d_;
  Matrix jacobian_;
  Eigen::PartialPivLU<Matrix> factors_;
  S factored_h_{};
  bool jacobian_fits_ = false;
  Vector y_, z_, stage_, dy_, moved_, delta_;
  std::int64_t evaluations_ = 0;
};

extern template class CollocationSolver<float>;
extern template class CollocationSolver<double>;
extern template class CollocationSolver<long double>;

template <class System, int stages>
class GaussMethod {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit GaussMethod(const System& system) : solver_(system, stages) {}
  const char* step(const System&, S t, S h, Flat& y) { return solver_.step(t, h, y.data()); }
  std::int64_t evaluations() const { return solver_.evaluations(); }

 private:
  CollocationSolver<S> solver_;
};

}  // namespace polhode
