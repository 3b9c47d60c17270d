// SPDX-License-Identifier: BSD-3-Clause
// What the explicit Runge–Kutta methods on the group share. The state is a point of SO(3)ⁿ × Rᵐ: orientations move by
// exponentials of ξ(q, v), while positions, velocities and the work are the abelian part of the same group, on which
// every such method is the Runge–Kutta method of its weights.
// Source: Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group methods, Acta Numerica 9 (2000).
#pragma once

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// The right-hand side at one point: ξ in the algebra, and v̇ and the power beside it.
template <class System>
class LieStage {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  using Tangent = typename System::Tangent;

  explicit LieStage(const System& system) : rate_(system.zero()), twist_(system.zero_tangent()) {}

  // Compiled once each and not in every stage: beside the sines a call is nothing, and a method builds in half the
  // time.
  [[gnu::noinline]] POLHODE_FLATTEN void evaluate(const System& system, S t, const Flat& y) {
    system.rate(t, y, rate_);
    system.twist(y, twist_);
  }

  [[gnu::noinline]] POLHODE_FLATTEN static void retract(const System& system, const Tangent& step, Flat& y) {
    system.retract(y, step);
  }

  const Tangent& twist() const { return twist_; }

  /// (v, work) ← (v, work) + c (v̇, power), the orientation left alone.
  void add_to(const System& system, S c, Flat& y) {
    system.velocity_part(y) += c * system.velocity_part(rate_);
    system.work_part(y) += c * system.work_part(rate_);
  }

 private:
  Flat rate_;
  Tangent twist_;
};

}  // namespace polhode
