// SPDX-License-Identifier: BSD-3-Clause
// Semi-implicit Euler: v' = v + h v̇(t, q, v), then q' = q + h N(q) v', with the new velocity and the old q in N.
// Source: the course report, section 2.1, whose update() moves the velocities first and then the positions:
// ds = v dt, dR = ω* R dt. Additive in the orientation; symplectic for translation under a potential only.
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class SemiImplicitEuler {
 public:
  static_assert(PartitionedOde<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit SemiImplicitEuler(const System& system) : rate_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    system.acceleration(t, y, rate_);
    system.velocity_part(y) += h * system.velocity_part(rate_);
    system.configuration_rate(t, y, rate_);
    system.configuration_part(y) += h * system.configuration_part(rate_);
    system.work_part(y) += h * system.work_part(rate_);
  }

 private:
  Flat rate_;
};

IntegratorEntry semi_implicit_euler() {
  return additive_step<SemiImplicitEuler, in_lanes>(
      {.name = "semi_implicit_euler",
       .family = "textbook",
       .summary = "v' = v + h a(t, q, v), then q' = q + h N(q) v', as the report updates",
       .order = 1,
       .evaluations_per_step = 1});
}

}  // namespace polhode
