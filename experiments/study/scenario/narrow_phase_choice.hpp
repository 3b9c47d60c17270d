// SPDX-License-Identifier: BSD-3-Clause
// Chooses a narrow phase that supports the shapes of a scenario.
#pragma once

#include <string>
#include <string_view>

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline scenario {

/// Reason, in its own words, why a narrow phase does not support some two shapes of the scenario; empty if it supports
/// all.
std::string narrow_phase_refusal(std::string_view narrow_phase, const Scenario& scenario);

/// `sat` if it supports all shapes, else `gjk`, which supports all convex shapes.
std::string narrow_phase_for(const Scenario& scenario);

}  // namespace polhode::study::scenario
