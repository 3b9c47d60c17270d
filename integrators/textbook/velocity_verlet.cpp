// SPDX-License-Identifier: BSD-3-Clause
// Velocity Verlet with a group step for the orientation, in the form for velocity-dependent accelerations:
//   k  = v̇(t, q, v),            v½ = v + h/2 k            half kick
//   q½ = q ⊕ h/2 ξ(q, v½),      q' = q ⊕ h ξ(q½, v½)      drift by the midpoint twist
//   ṽ  = v½ + h/2 k,            v' = v½ + h/2 v̇(t + h, q', ṽ)   half kick at the predicted velocity
// If forces depend on positions only, ṽ has no effect. The method is then Verlet's, symplectic and symmetric for
// translation. The gyroscopic term and drag are evaluated at ṽ = v + h k, which is accurate to O(h²), so that v' agrees
// with the trapezoidal rule to O(h³). At v½ instead of ṽ the second kick would be of order 1. ξ depends on q only for
// momentum_world, where ω(q½, L½) rotates the body with L½ fixed. For an angular velocity the drift is one exponential
// of h v½. The work follows by the trapezoidal rule from the power at (t, q, v) and (t + h, q', v'). The method is
// explicit and of order 2. It needs two evaluations per step, because v̇ at ṽ cannot be reused in the next step.
// Sources: Swope, Andersen, Berens & Wilson, J. Chem. Phys. 76 (1982); Groot & Warren, J. Chem. Phys. 107 (1997) with
// λ = 1 for the velocity-dependent kick.
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class VelocityVerlet {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit VelocityVerlet(const System& system)
      : first_(system.zero()), second_(system.zero()), middle_(system.zero()), step_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2);
    system.rate(t, y, first_);
    system.velocity_part(y) += half * system.velocity_part(first_);

    middle_ = y;
    system.twist(middle_, step_);
    step_ *= half;
    system.retract(middle_, step_);
    system.twist(middle_, step_);
    step_ *= h;
    system.retract(y, step_);

    middle_ = y;
    system.velocity_part(middle_) += half * system.velocity_part(first_);
    system.acceleration(t + h, middle_, second_);
    system.velocity_part(y) += half * system.velocity_part(second_);
    system.configuration_rate(t + h, y, second_);
    system.work_part(y) += half * (system.work_part(first_) + system.work_part(second_));
  }

 private:
  Flat first_, second_, middle_;
  typename System::Tangent step_;
};

IntegratorEntry velocity_verlet() {
  return fixed_step<VelocityVerlet>({.name = "velocity_verlet",
                                     .family = "textbook",
                                     .summary = "half kick, drift q' = q exp(h w), half kick at the predicted velocity",
                                     .equation = R"(k &= \dot v(t_n, q_n, v_n), \quad v_{n+1/2} = v_n + \tfrac12 h\,k \\
q_{n+1/2} &= q_n \oplus \tfrac12 h\,\xi(q_n, v_{n+1/2}) \\
q_{n+1} &= q_n \oplus h\,\xi(q_{n+1/2}, v_{n+1/2}) \\
v_{n+1} &= v_{n+1/2} + \tfrac12 h\,\dot v\bigl(t_n + h,\; q_{n+1},\; v_{n+1/2} + \tfrac12 h\,k\bigr))",
                                     .sources = {"swope1982", "grootWarren1997"},
                                     .order = 2,
                                     .evaluations_per_step = 2,
                                     .lie_group = true});
}

}  // namespace polhode::integrators
