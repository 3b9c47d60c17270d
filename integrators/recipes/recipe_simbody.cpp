// SPDX-License-Identifier: BSD-3-Clause
// The free-body update of Simbody: the recipe of ODE in two half steps. It reproduces the published results of Peters &
// Hsu for Simbody.
// Source: Peters & Hsu, Comparison of Rigid Body Dynamic Simulators for Robotic Simulation in Gazebo.
#include "integrators/recipes/engine_recipe.hpp"

namespace polhode::inline integrators {

template <class System>
class SimbodyStep {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit SimbodyStep(const System& system) : half_step_(system) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2);
    half_step_.step(system, t, half, y);
    half_step_.step(system, t + half, half, y);
  }

 private:
  OdeStep<System> half_step_;
};

IntegratorEntry recipe_simbody() {
  return engine_recipe<SimbodyStep>({.name = "recipe_simbody",
                                     .family = "engine recipe",
                                     .summary = "Simbody: ODE's recipe in two half steps",
                                     .equation = R"(y_{n+1} &= \Psi_{h/2} \circ \Psi_{h/2}\,(y_n), \quad \Psi_h: \\
v_{n+1} &= v_n + h\,\dot v(t_n, q_n, v_n), \quad x_{n+1} = x_n + h\,\dot x_{n+1} \\
\mathsf q_{n+1} &= \frac{\mathsf q_n + \tfrac12 h\,(0, \omega_{n+1})\,\mathsf q_n}
  {\bigl|\mathsf q_n + \tfrac12 h\,(0, \omega_{n+1})\,\mathsf q_n\bigr|})",
                                     .sources = {"petersHsu2015"},
                                     .order = 1,
                                     .evaluations_per_step = 2,
                                     .normalizes = true});
}

}  // namespace polhode::integrators
