// SPDX-License-Identifier: BSD-3-Clause
// Is each method what it declares to be: its order, what it conserves, whether it is reversible and symplectic?
#include "experiments/certificate/certificate_report.hpp"
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "certificate",
       .question = "Is each method what it declares to be?",
       .defaults = {{"scenario", "hairer_vilmart"},
                    {"integrator", "all"},
                    {"orientation", "quaternion,matrix"},
                    {"angular-state", "velocity_world,velocity_body,momentum_world"},
                    {"dt", "0.2,0.1,0.05,0.025,0.0125,0.00625,0.003125,0.0015625,0.00078125"},
                    {"tolerance", "1e-5,1e-6,1e-7,1e-8,1e-9,1e-10,1e-11"},
                    {"t-end", "2"}},
       .with_joints = {.defaults = {{"scenario", "double_pendulum"},
                                    {"dt", "0.04,0.02,0.01,0.005,0.0025,0.00125,0.000625"},
                                    {"t-end", "1"}},
                       .reference = true},
       .reference = true,
       .more = {{.defaults = {{"scenario", "spring_box"},
                              {"dt", "0.04,0.02,0.01,0.005,0.0025,0.00125,0.000625,0.0003125,0.00015625"},
                              {"t-end", "1"}},
                 .reference = true},
                {.defaults = {{"scenario", "hairer_vilmart,kovalevskaya_top"},
                              {"dt", "0.1"},
                              {"tolerance", "1e-8"},
                              {"t-end", "200"}}}},
       .analysis_alone = true,
       .analysis = polhode::study::certificate::certificates,
       .needs = {.analysis = 1.3}},
      argc, argv);
}
