// SPDX-License-Identifier: BSD-3-Clause
// Up to which step is each method stable on a motion, and what becomes of the energy beyond it?
#include "experiments/stability/ladder.hpp"
#include "experiments/stability/stability.hpp"
#include "experiments/study/study.hpp"

namespace {

/// The second moment of inertia beside 0.6 and 1 kg m², as far as a rigid body can have it.
const polhode::study::FurtherAxes map_over_inertia = {
    .defaults = {{"scenario", "hairer_vilmart"},
                 {"integrator", "explicit_euler,heun,rk4,simo_wong,lie_midpoint,dmv4"},
                 {"dt", "0.02:10:24:log"}},
    .vary = {{"body.0.inertia.1", "0.42:1.58:16"}},
    .by_default_only = true};

}  // namespace

int main(int argc, char** argv) {
  return polhode::study::run_experiment({.name = "stability",
                                         .question = "Up to which step is each method stable?",
                                         .defaults = {{"scenario", "oscillator,hairer_vilmart"},
                                                      {"integrator", "all"},
                                                      {"dt", "0.02:100:38:log"},
                                                      {"t-end", "40"}},
                                         .more = {map_over_inertia},
                                         .fixed_steps_only = true,
                                         .failures_are_results = true,
                                         .duration = polhode::study::whole_steps,
                                         .refine = polhode::study::bisection,
                                         .analysis = polhode::study::stability},
                                        argc, argv);
}
