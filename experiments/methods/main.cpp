// SPDX-License-Identifier: BSD-3-Clause
// Which method reaches an error at the least cost, over many problems of one kind?
#include "experiments/methods/groups.hpp"
#include "experiments/methods/ladder.hpp"
#include "experiments/methods/methods.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_experiment(
      {.name = "methods",
       .question = "Which method reaches an error at the least cost, over problems of one kind?",
       .meaning = "The runs that --dt and --tolerance give only name the methods; their steps and tolerances are then "
                  "chosen until the error is below 1e-10 or the budget is spent.",
       .defaults = {{"scenario", methods::all_scenarios()},
                    {"integrator", "all"},
                    {"angular-state", "velocity_world,velocity_body,momentum_world"},
                    {"orientation", "quaternion,matrix"},
                    {"dt", "0.125"},
                    {"tolerance", "1e-2"},
                    {"impact-timing", "time_stepping,event_located"}},
       .reference = true,
       .failures_are_results = true,
       .refine = methods::next_rungs,
       .analysis_alone = true,
       .analysis = methods::comparison,
       .needs = {.refined = 20, .analysis = 0.1, .figures = 3}},
      argc, argv);
}
