// SPDX-License-Identifier: BSD-3-Clause
// Common part of the engine recipes: the formulation of physics engines and the update of the Open Dynamics Engine.
#pragma once

#include <string>

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// Refuses every formulation but that of engines: quaternion and world angular velocity.
inline std::string needs_an_engine_state(const Problem&, const Formulation& formulation) {
  return formulation.orientation == Orientation::quaternion && formulation.angular_state == AngularState::velocity_world
             ? ""
             : "an engine keeps a quaternion and the angular velocity in the world";
}

/// The update of the Open Dynamics Engine: v' = v + h v̇(t, q, v) with an explicit gyroscopic torque, p' = p + h v',
/// q' = (q + h/2 ω' q)/|q + h/2 ω' q|. The work uses the power of v' at the old q.
template <class System>
class OdeStep {
 public:
  static_assert(PartitionedOde<System> && Measurable<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit OdeStep(const System& system) : rate_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    system.acceleration(t, y, rate_);
    system.velocity_part(y) += h * system.velocity_part(rate_);
    system.configuration_rate(t, y, rate_);
    system.configuration_part(y) += h * system.configuration_part(rate_);
    system.work_part(y) += h * system.work_part(rate_);
    system.project_flat(y.data());
  }

 private:
  Flat rate_;
};

/// Catalogue entry of an engine recipe.
template <template <class> class Recipe>
IntegratorEntry engine_recipe(Declaration declaration) {
  IntegratorEntry entry = fixed_step<Recipe>(std::move(declaration));
  entry.refusal = needs_an_engine_state;
  return entry;
}

}  // namespace polhode::integrators
