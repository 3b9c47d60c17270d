// SPDX-License-Identifier: BSD-3-Clause
// What does a pile of N bodies cost, how far does its energy rise, and how deep are its bodies in each other?
#include "experiments/pile/cost.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment({.name = "pile",
                                         .question = "What does a pile of N bodies cost, how far does its energy rise, "
                                                     "and how deep are its bodies in each other?",
                                         .defaults = {{"scenario", "pile_10,pile_100,pile_1000"},
                                                      {"integrator", "semi_implicit_euler"},
                                                      {"dt", "0.0166666666666667"},
                                                      {"response", "sequential_impulses"}},
                                         .best_times = true,
                                         .fixed_steps_only = true,
                                         .analysis_alone = true,
                                         .analysis = polhode::study::pile::what_piles_cost,
                                         .needs = {.figures = 2}},
                                        argc, argv);
}
