// SPDX-License-Identifier: BSD-3-Clause
// Up to which step is each method stable on a motion and follows it, and what becomes of the energy beyond it?
#include <fmt/format.h>

#include "experiments/stability/stability.hpp"
#include "experiments/stability/step_ladder.hpp"
#include "experiments/study/study.hpp"

namespace {

/// Values of the second principal moment of inertia, beside 0.6 and 1 kg m², that a rigid body can have.
const polhode::study::FurtherAxes map_over_inertia = {
    .defaults = {{"scenario", "hairer_vilmart"},
                 {"integrator", "explicit_euler,heun,rk4,simo_wong,lie_midpoint,dmv4"},
                 {"dt", "0.02:10:24:log"}},
    .vary = {{"body.0.inertia.1", "0.42:1.58:16"}},
    .by_default_only = true};

std::string meaning() {
  using namespace polhode::study;
  using namespace polhode::study::stability;
  return fmt::format(
      "Two limits, each the largest step below which it holds: the energy does not grow (a gain of less than "
      "{:g} % of its scale in a turn 2π/|ω| is slow and no growth, but where the system is linear), and the "
      "motion is followed for the duration asked for: attitude error below {:g} rad, position error below "
      "{:g} of the largest displacement, relative drift of momenta and further invariants below {:g}, "
      "orientation defect below {:g}. Errors are against the exact motion or, with --reference, against a "
      "reference.",
      100 * verdict::slow, followed::attitude, followed::position, followed::momentum, followed::defect);
}

}  // namespace

int main(int argc, char** argv) {
  return polhode::study::run_experiment({.name = "stability",
                                         .question = "Up to which step is each method stable, and follows the motion?",
                                         .meaning = meaning(),
                                         .defaults = {{"scenario", "oscillator,hairer_vilmart"},
                                                      {"integrator", "all"},
                                                      {"dt", "0.02:100:38:log"},
                                                      {"t-end", "40"}},
                                         .more = {map_over_inertia},
                                         .fixed_steps_only = true,
                                         .failures_are_results = true,
                                         .curves_are_results = true,
                                         .duration = polhode::study::stability::whole_steps,
                                         .refine = polhode::study::stability::bisection,
                                         .analysis = polhode::study::stability::stability,
                                         .needs = {.refined = 0.34, .analysis = 0.75, .figures = 3}},
                                        argc, argv);
}
