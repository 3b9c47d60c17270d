// SPDX-License-Identifier: BSD-3-Clause
// The free-body update of the Open Dynamics Engine: semi-implicit Euler with the gyroscopic torque −ω × Iω of the old
// state, then the first-order quaternion update with the new ω, with normalization as part of the recipe.
// Source: ODE, dxStepBody and its gyroscopic mode; Peters & Hsu, Comparison of Rigid Body Dynamic Simulators for
// Robotic Simulation in Gazebo, whose figures for ODE it gives.
#include "integrators/recipes/engine_recipe.hpp"

namespace polhode::inline integrators {

IntegratorEntry recipe_ode() {
  return engine_recipe<OdeStep>(
      {.name = "recipe_ode",
       .family = "engine recipe",
       .summary = "ODE: v' = v + h a, then q' = q + h/2 w' q, normalized",
       .equation = R"(v_{n+1} &= v_n + h\,\dot v(t_n, q_n, v_n), \quad x_{n+1} = x_n + h\,\dot x_{n+1} \\
\mathsf q_{n+1} &= \frac{\mathsf q_n + \tfrac12 h\,(0, \omega_{n+1})\,\mathsf q_n}
  {\bigl|\mathsf q_n + \tfrac12 h\,(0, \omega_{n+1})\,\mathsf q_n\bigr|})",
       .sources = {"openDynamicsEngine", "petersHsu2015"},
       .order = 1,
       .evaluations_per_step = 1,
       .normalizes = true});
}

}  // namespace polhode::integrators
