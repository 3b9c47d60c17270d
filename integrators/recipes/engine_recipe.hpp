// SPDX-License-Identifier: BSD-3-Clause
// Common part of the engine recipes: the formulation of physics engines and the update of the Open Dynamics Engine.
#pragma once

#include <Eigen/LU>
#include <string>

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// Refuses every formulation but that of engines: quaternion and world angular velocity.
inline std::string needs_an_engine_state(const Problem&, const Formulation& formulation) {
  return formulation.orientation == Orientation::quaternion && formulation.angular_state == AngularState::velocity_world
             ? ""
             : "an engine keeps a quaternion and the angular velocity in the world";
}

/// Bullet's gyroscopic update of the angular momentum m (principal axes) over h: one Newton step of
/// I (Ω' − Ω) + h Ω' × IΩ' = 0 from Ω' = Ω.
template <class Body, class S>
void spin_by_newton_step(const Body& body, S h, Vector3<S>& m) {
  const Vector3<S> w = body.inverse_moments.cwiseProduct(m);
  Matrix3<S> jacobian = h * (skew<S>(w) * body.moments.asDiagonal() - skew<S>(m));
  jacobian.diagonal() += body.moments;
  m += body.moments.cwiseProduct(Vector3<S>(jacobian.inverse() * Vector3<S>(-h * w.cross(m))));
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

/// Refuses joints besides: what an engine does with them is another recipe.
inline std::string needs_a_body_without_joints(const Problem& problem, const Formulation& formulation) {
  if (!problem.joints.empty()) {
    return "it is what an engine does without joints; take recipe_bullet_joints, recipe_ode_step, "
           "recipe_ode_quickstep, recipe_dart_joints or recipe_box2d_soft_step";
  }
  return needs_an_engine_state(problem, formulation);
}

/// Catalogue entry of an engine recipe.
template <template <class> class Recipe>
IntegratorEntry engine_recipe(Declaration declaration) {
  declaration.refuses_joints = true;
  IntegratorEntry entry = fixed_step<Recipe, Forms::engine_body>(std::move(declaration));
  entry.refusal = needs_a_body_without_joints;
  return entry;
}

}  // namespace polhode::integrators
