// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/groups.hpp"

#include <algorithm>

namespace polhode::study::methods {

const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"free_tops",
       "Free tops",
       Measure::motion,
       {"hairer_vilmart", "detest_b5", "dzhanibekov", "peters_hsu", "free_symmetric_top", "dyadic_top"}},
      // The spin about the axis of symmetry has more than five times the energy m g l.
      {"fast_tops", "Fast tops", Measure::motion, {"lagrange_top", "simo_wong", "sleeping_top", "gyroscope"}},
      {"heavy_tops",
       "Other heavy tops",
       Measure::motion,
       {"kovalevskaya_top", "goryachev_chaplygin", "spinning_pendulum", "physical_pendulum", "heavy_box"}},
      {"translation",
       "Translation",
       Measure::motion,
       {"oscillator", "three_balls", "elastic_pendulum", "projectile", "thrown_ball", "two_bodies", "figure_eight"}},
      {"springs",
       "Bodies on springs",
       Measure::motion,
       {"coursework", "spring_box", "joined_boxes", "hung_plate", "held_gyroscope"}},
      {"impacts",
       "Impacts",
       Measure::impact,
       {"cube_bouncing", "tumbling_cube", "spinning_cubes", "two_cubes", "edge_on_edge", "vertex_on_face"}},
      {"stacks", "Stacks", Measure::rest, {"pyramid", "tower", "table"}}};
  return all;
}

Group group_of(const Scenario& scenario) {
  for (const Group& group : groups()) {
    const auto& names = group.scenarios;
    if (std::find(names.begin(), names.end(), scenario.name) != names.end()) return group;
  }
  if (scenario.colliders.empty()) return {"other_motions", "Other motions", Measure::motion, {}};
  return {"other_impacts", "Other impacts", Measure::impact, {}};
}

std::string all_scenarios() {
  std::string text;
  for (const Group& group : groups()) {
    for (const auto& name : group.scenarios) text += (text.empty() ? "" : ",") + name;
  }
  return text;
}

}  // namespace polhode::study::methods
