// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/first_impact.hpp"

#include "experiments/study/scenario/narrow_phase_choice.hpp"

namespace polhode::study::inline record {

RunConfig first_impact_reference(const RunRecord& run) {
  RunConfig c = run.config;
  c.integrator = first_impact_method;
  c.formulation = {};
  c.normalize = false;
  c.precision = Precision::double_precision;
  c.settings.clear();
  if (c.summation) c.summation = Summation::plain;
  c.contact = ContactConfig{"sweep_and_prune", narrow_phase_for(*run.scenario), "sequential_impulses", "event_located"};
  c.dt.reset();
  c.tolerance = first_impact_tolerance;
  c.samples.reset();
  return c;
}

bool is_first_impact_reference(const RunConfig& c) {
  return c.contact && c.contact->impact_timing == "event_located" && c.integrator == first_impact_method &&
         c.tolerance == first_impact_tolerance && !c.samples;
}

}  // namespace polhode::study::record
