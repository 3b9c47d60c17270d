// SPDX-License-Identifier: BSD-3-Clause
// How do energy and momentum drift, method by method and step by step, and how far is the motion from the exact one?
#include "experiments/study/study.hpp"

int main(int argc, char** argv) {
  return polhode::study::run_experiment(
      {.name = "energy_drift",
       .question = "How do energy and momentum drift, and how far is the motion from the exact one?",
       .defaults = {{"scenario", "peters_hsu"},
                    {"integrator",
                     "explicit_euler,semi_implicit_euler,explicit_midpoint,rk4,lie_midpoint,dmv,cvode_adams,"
                     "cvode_bdf,odeint_dopri5"},
                    {"dt", "5e-4,1e-3,2e-3,5e-3,1e-2,2e-2"},
                    {"tolerance", "1e-4,1e-6,1e-8,1e-10,1e-12"}}},
      argc, argv);
}
