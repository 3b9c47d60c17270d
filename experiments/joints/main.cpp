// SPDX-License-Identifier: BSD-3-Clause
// Which methods keep joints closed, at what cost, and what are their reactions worth?
#include "experiments/joints/closed_joints.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  const std::string scenarios = "rod_pendulum,ball_joint_top,double_pendulum";
  return polhode::study::run_experiment(
      {.name = "joints",
       .question = "Which methods keep joints closed, at what cost, and what are their reactions worth?",
       .defaults = {{"scenario", scenarios},
                    {"integrator", "rk4,odeint_dopri5,cvode_bdf"},
                    {"stabilization", "none,baumgarte,position,velocity,both,penalty"},
                    {"dt", "4e-3,2e-3,1e-3,5e-4"},
                    {"tolerance", "1e-4,1e-6,1e-8,1e-10"},
                    {"t-end", "1"}},
       .reference = true,
       .more = {{.defaults = {{"integrator",
                               "shake,rattle,half_explicit4,generalized_alpha_index3,generalized_alpha_index2,"
                               "ida_index1,ida_index2,ida_index3,ida_ggl,ida_ah,recipe_ode_step,recipe_bullet_joints,"
                               "recipe_box2d_soft_step"},
                              {"stabilization", "none"}},
                 .reference = true,
                 .by_default_only = true}},
       .failures_are_results = true,
       .analysis_alone = true,
       .analysis = polhode::study::joints::how_joints_hold,
       .needs = {.analysis = 0.1, .figures = 2}},
      argc, argv);
}
