// SPDX-License-Identifier: BSD-3-Clause
// Up to which step is each method stable on a motion, and what becomes of the energy beyond it?
#include "experiments/stability/ladder.hpp"
#include "experiments/stability/stability.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment({.name = "stability",
                                         .question = "Up to which step is each method stable?",
                                         .defaults = {{"scenario", "oscillator,hairer_vilmart"},
                                                      {"integrator", "all"},
                                                      {"dt", "0.02:100:38:log"}},
                                         .fixed_steps_only = true,
                                         .failures_are_results = true,
                                         .duration = polhode::study::whole_steps,
                                         .refine = polhode::study::bisection,
                                         .analysis = polhode::study::stability},
                                        argc, argv);
}
