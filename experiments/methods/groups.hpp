// SPDX-License-Identifier: BSD-3-Clause
// The groups of scenarios over which methods are compared, fixed before anything is measured.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::methods {

/// The kind of the error of a run (see Ruler).
enum class Measure {
  motion,  ///< distance from the exact motion or the reference
  impact,  ///< time of the first impact, and energy
  rest     ///< displacement of bodies that are in balance
};

struct Group {
  std::string name;   ///< "free_tops"
  std::string title;  ///< "Free tops"
  Measure measure = Measure::motion;
  std::vector<std::string> scenarios;  ///< names of built-in scenarios
};

const std::vector<Group>& groups();

/// The group of a scenario. One that is in none of the groups above is in a group `other_motions` or `other_impacts`.
Group group_of(const Scenario& scenario);

/// The scenarios of all groups as a list for --scenario.
std::string all_scenarios();

}  // namespace polhode::study::methods
