// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/impact_timing.hpp"

#include <algorithm>

#include "collision/contact/event_located.hpp"
#include "collision/contact/time_stepping.hpp"
#include "core/problem/catalogue.hpp"

namespace polhode::inline collision::inline contact {
namespace {

template <Reflected reflected>
std::unique_ptr<ContactModel> at_step(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response) {
  return std::make_unique<TimeStepping>(system, scene, std::move(response), reflected);
}
std::unique_ptr<ContactModel> located(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response) {
  return std::make_unique<EventLocated>(system, scene, std::move(response));
}

}  // namespace

const std::vector<ImpactTimingEntry>& impact_timing_catalogue() {
  static const std::vector<ImpactTimingEntry> entries = {
      {"time_stepping", "contacts where a step starts; restitution reflects the velocity there", true,
       at_step<Reflected::at_start>},
      {"time_stepping_free_end", "the same; restitution reflects the velocity that the step would end with", true,
       at_step<Reflected::at_free_end>},
      {"event_located", "impacts where a signed distance crosses zero: roots of the method's own, or TOMS 748", false,
       located},
  };
  return entries;
}

const ImpactTimingEntry* find_impact_timing(std::string_view name) {
  return find_entry(impact_timing_catalogue(), name);
}

}  // namespace polhode::collision::contact
