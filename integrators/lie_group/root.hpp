// SPDX-License-Identifier: BSD-3-Clause
// The root x = g(x) of an implicit step, in two stages.
//
// Broyden's method starts from plain iteration and learns the derivative from its own steps: no derivative, no matrix,
// a handful of evaluations where h|ω| and h² times the stiffness over the mass are moderate. Where it does not
// converge, Newton's method with a Jacobian by difference quotients begins again at the guess: n evaluations and a
// dense LU factorisation an iteration, and it takes any stiffness. Both go on until round-off stops them. Source:
// Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995, 5.4 and 7.3 (Broyden's good update as a
// recurrence of steps).
#pragma once

#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline integrators {

/// f(x) = x − g(x) for one step, x lengths in m and angles in rad.
template <class S>
class StepEquations {
 public:
  StepEquations() = default;
  StepEquations(const StepEquations&) = default;
  StepEquations& operator=(const StepEquations&) = default;
  virtual ~StepEquations() = default;
  virtual void residual(const VectorX<S>& x, VectorX<S>& f) = 0;
};

template <class S>
class RootFinder {
 public:
  /// Moves x from the guess to the root, to round-off relative to `scale`, the largest number that x is added to.
  /// Null, or why there is none; x is worthless then.
  const char* solve(StepEquations<S>& equations, VectorX<S>& x, S scale);

 private:
  bool broyden(StepEquations<S>& equations, VectorX<S>& x, S scale);
  bool newton(StepEquations<S>& equations, VectorX<S>& x, S scale);

  VectorX<S> guess_, f_, moved_;
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> jacobian_;
  std::vector<VectorX<S>> steps_;
  std::vector<S> squares_;
};

}  // namespace polhode
