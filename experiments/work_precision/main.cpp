// SPDX-License-Identifier: BSD-3-Clause
// What does an exact result cost, method by method: right-hand sides, and time, against the true error?
#include "experiments/study/study.hpp"
#include "experiments/work_precision/work.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "work_precision",
       .question = "Which method reaches a given error with the fewest right-hand sides, and in the least time?",
       .defaults = {{"scenario", "hairer_vilmart,detest_b5,peters_hsu"},
                    {"integrator", "all"},
                    {"dt", "0.2,0.1,0.05,0.025,0.0125,0.00625,0.003125,0.0015625,0.00078125"},
                    {"tolerance", "1e-2,1e-3,1e-4,1e-5,1e-6,1e-7,1e-8,1e-9,1e-10,1e-11,1e-12"},
                    {"samples", "1"}},
       .best_times = true,
       .analysis = polhode::study::work_precision::work_against_error,
       .needs = {.figures = 2}},
      argc, argv);
}
