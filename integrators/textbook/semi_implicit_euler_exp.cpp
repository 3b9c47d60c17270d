// SPDX-License-Identifier: BSD-3-Clause
// Semi-implicit Euler with the exponential map: v' = v + h v̇(t, q, v), then the group step q' = q ⊕ h ξ(q, v'), which
// is exp(hω') R in world axes and R exp(hΩ') in body axes. It equals the report's update except that orientations stay
// on their manifold. The work uses the power of v' at the old q. Source: the course report, section 2.1, with the
// exponential map in place of dR = ω* R dt.
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class SemiImplicitEulerExp {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit SemiImplicitEulerExp(const System& system) : rate_(system.zero()), step_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    system.acceleration(t, y, rate_);
    system.velocity_part(y) += h * system.velocity_part(rate_);
    system.configuration_rate(t, y, rate_);
    system.work_part(y) += h * system.work_part(rate_);
    system.twist(y, step_);
    step_ *= h;
    system.retract(y, step_);
  }

 private:
  Flat rate_;
  typename System::Tangent step_;
};

IntegratorEntry semi_implicit_euler_exp() {
  return fixed_step<SemiImplicitEulerExp>({.name = "semi_implicit_euler_exp",
                                           .family = "textbook",
                                           .summary = "v' = v + h a(t, q, v), then q' = q exp(h w')",
                                           .equation = R"(v_{n+1} &= v_n + h\,\dot v(t_n, q_n, v_n) \\
q_{n+1} &= q_n \oplus h\,\xi(q_n, v_{n+1}))",
                                           .sources = {"courseReport", "iserles2000"},
                                           .order = 1,
                                           .evaluations_per_step = 1,
                                           .lie_group = true});
}

}  // namespace polhode::integrators
