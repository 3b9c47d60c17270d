// SPDX-License-Identifier: BSD-3-Clause
// How does one scenario move? One run, with its trajectory and its energy ledger.
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "simulate",
       .question = "How does one scenario move?",
       .defaults = {{"scenario", "peters_hsu"}, {"integrator", "rk4"}, {"dt", "1e-3"}, {"tolerance", "1e-8"}},
       .one_run = true},
      argc, argv);
}
