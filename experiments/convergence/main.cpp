// SPDX-License-Identifier: BSD-3-Clause
// At which order does each method converge to the exact motion, with what confidence, and is it the order it declares?
#include "experiments/convergence/orders.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "convergence",
       .question = "At which order does each method converge, and is it the order that it declares?",
       .defaults = {{"scenario", "hairer_vilmart,free_symmetric_top,peters_hsu"},
                    {"integrator", "all"},
                    {"dt", "0.1,0.05,0.025,0.0125,0.00625,0.003125,0.0015625,0.00078125,0.000390625"},
                    {"tolerance", "1e-4,1e-5,1e-6,1e-7,1e-8,1e-9,1e-10,1e-11"},
                    {"t-end", "2"}},
       .with_joints = {.defaults = {{"scenario", "double_pendulum"},
                                    {"dt", "0.04,0.02,0.01,0.005,0.0025,0.00125,0.000625"},
                                    {"t-end", "1"}},
                       .reference = true},
       .analysis = polhode::study::convergence::observed_orders},
      argc, argv);
}
