// SPDX-License-Identifier: BSD-3-Clause
// The Gauss methods for the flat ODE ẏ = f(t, y): implicit Runge–Kutta methods of s stages and order 2s,
//   Z_i = h Σ_j a_ij f(t + c_j h, y + Z_j),  y' = y + Σ_i d_i Z_i with d = bᵀ A⁻¹.
// The update of the orientation is additive. The methods are symmetric and conserve every quadratic first integral of
// the flat ODE: |q|² or RᵀR, and for velocity_body also the energy and |IΩ|.
// Sources: Hairer & Wanner, Solving Ordinary Differential Equations II, IV.5 and IV.8 (implementation); Hairer, Lubich
// & Wanner, Geometric Numerical Integration, 2nd ed., IV.2.
//
// Simplified Newton iteration, (1 − h A ⊗ J) ΔZ = residual, solves for the stages to the round-off of the scalar. J is
// computed by difference quotients. It is reused in the next step while the iteration contracts by a factor of 20 or
// more. It is recomputed at the stages within a step if the contraction factor is less than 2. h|J| is not limited: a
// linear problem takes one iteration.
#pragma once

#include <Eigen/LU>
#include <cstdint>
#include <string>
#include <utility>

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// Solver for one step. It uses the interface Ode and is therefore compiled once for each scalar (collocation.cpp).
template <class S>
class CollocationSolver {
 public:
  CollocationSolver(const Ode<S>& ode, int stages);

  /// Advances y from time t (s) by h (s). Returns null, or the reason of a failure.
  const char* step(S t, S h, S* y);
  std::int64_t evaluations() const { return evaluations_; }
  std::int64_t iterations() const { return iterations_; }

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
  std::int64_t evaluations_ = 0, iterations_ = 0;
};

extern template class CollocationSolver<float>;
extern template class CollocationSolver<double>;
extern template class CollocationSolver<long double>;

/// The reason for which the linear system of a Gauss method is too large for this problem; empty if it is not.
std::string refuse_large_system(int stages, const Problem& problem, const Formulation& formulation);

/// The catalogue entry of the Gauss method with the given number of stages.
template <template <class> class Method, int stages>
IntegratorEntry gauss_method(Declaration declaration) {
  IntegratorEntry entry = additive_step<Method, Forms::many_bodies>(std::move(declaration));
  entry.refusal = [](const Problem& p, const Formulation& f) { return refuse_large_system(stages, p, f); };
  return entry;
}

/// The Gauss method with the given number of stages.
template <class System, int stages>
class GaussMethod {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit GaussMethod(const System& system) : solver_(system, stages) {}
  const char* step(const System&, S t, S h, Flat& y) { return solver_.step(t, h, y.data()); }
  std::int64_t evaluations() const { return solver_.evaluations(); }
  std::int64_t iterations() const { return solver_.iterations(); }

 private:
  CollocationSolver<S> solver_;
};

}  // namespace polhode::integrators
