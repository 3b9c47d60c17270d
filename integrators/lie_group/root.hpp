// SPDX-License-Identifier: BSD-3-Clause
// Solver for the equation x = g(x) of an implicit step: Broyden's method, then Newton's method if that fails.
//
// Broyden's method starts from fixed-point iteration and approximates the derivative from its own steps, without a
// Jacobian or a matrix. It takes a few evaluations if h|ω| and h² × stiffness/mass are moderate. If it does not
// converge, Newton's method restarts at the initial guess with a Jacobian by difference quotients. Each of its
// iterations takes n evaluations and a dense LU factorization; it handles any stiffness. Both iterate until round-off
// dominates. Source: Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995, 5.4 and 7.3 (Broyden's
// good update as a recurrence of steps).
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline integrators {

/// The residual f(x) = x − g(x) of one step. The entries of x are lengths (m) and angles (rad).
template <class S>
class StepEquations {
 public:
  StepEquations() = default;
  StepEquations(const StepEquations&) = default;
  StepEquations& operator=(const StepEquations&) = default;
  virtual ~StepEquations() = default;
  virtual void residual(const VectorX<S>& x, VectorX<S>& f) = 0;
};

/// Solver for x = g(x) in the scalar S.
template <class S>
class RootFinder {
 public:
  /// Solves for x, which holds the initial guess. The result is accurate to round-off relative to `scale`, the largest
  /// number to which x is added. Returns null, or the reason of a failure; x is then unspecified.
  const char* solve(StepEquations<S>& equations, VectorX<S>& x, S scale);

  /// Number of iterations of both methods in all calls.
  std::int64_t iterations() const { return iterations_; }

 private:
  bool broyden(StepEquations<S>& equations, VectorX<S>& x, S scale);
  bool newton(StepEquations<S>& equations, VectorX<S>& x, S scale);

  VectorX<S> guess_, f_, moved_;
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> jacobian_;
  std::vector<VectorX<S>> steps_;
  std::vector<S> squares_;
  std::int64_t iterations_ = 0;
};

}  // namespace polhode::integrators
