// SPDX-License-Identifier: BSD-3-Clause
// Which narrow phase can answer for the shapes of a scenario.
#pragma once

#include <string>
#include <string_view>

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline scenario {

/// Why this narrow phase cannot answer for some two of the scenario's shapes, in its own words; empty if it can for
/// all.
std::string narrow_phase_refusal(std::string_view narrow_phase, const Scenario& scenario);

/// `sat` where it can answer, else `gjk`, which can for any convex shapes.
std::string narrow_phase_for(const Scenario& scenario);

}  // namespace polhode::study
