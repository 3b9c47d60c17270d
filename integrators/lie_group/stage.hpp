// SPDX-License-Identifier: BSD-3-Clause
// Common stage of the explicit Runge–Kutta methods on the Lie group SO(3)ⁿ × Rᵐ. Orientations are updated by
// exponentials of ξ(q, v). Positions, velocities and work form the abelian part of the group. On it every such method
// reduces to the Runge–Kutta method with the same weights. Source: Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group
// methods, Acta Numerica 9 (2000).
#pragma once

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// The right-hand side at one point: ξ in the Lie algebra, v̇, and the power.
template <class System>
class LieStage {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  using Tangent = typename System::Tangent;

  explicit LieStage(const System& system) : rate_(system.zero()), twist_(system.zero_tangent()) {}

  // The function is not inlined: the cost of a call is negligible beside the trigonometric functions, and a method
  // compiles in half the time.
  [[gnu::noinline]] POLHODE_FLATTEN void evaluate(const System& system, S t, const Flat& y) {
    system.rate(t, y, rate_);
    system.twist(y, twist_);
  }

  [[gnu::noinline]] POLHODE_FLATTEN static void retract(const System& system, const Tangent& step, Flat& y) {
    system.retract(y, step);
  }

  const Tangent& twist() const { return twist_; }

  /// (v, work) ← (v, work) + c (v̇, power). The orientation is unchanged.
  void add_to(const System& system, S c, Flat& y) {
    system.velocity_part(y) += c * system.velocity_part(rate_);
    system.work_part(y) += c * system.work_part(rate_);
  }

 private:
  Flat rate_;
  Tangent twist_;
};

}  // namespace polhode::integrators
