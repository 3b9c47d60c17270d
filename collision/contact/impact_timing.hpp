// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of timings: at which instants a run searches for contact and answers it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contact/contact_scene.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision::inline contact {

struct ImpactTimingEntry {
  std::string name;
  std::string summary;            ///< one line
  bool fixed_steps_only = false;  ///< makes no sense for a method that chooses its steps
  /// Registers its force with the system. System and scene must outlive it.
  std::unique_ptr<ContactModel> (*make)(System<double>&, ContactScene&, std::unique_ptr<Response>);
};

const std::vector<ImpactTimingEntry>& impact_timing_catalogue();
const ImpactTimingEntry* find_impact_timing(std::string_view name);

}  // namespace polhode::collision::contact
