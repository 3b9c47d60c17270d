// SPDX-License-Identifier: BSD-3-Clause
// The data of a scenario in words, beside its drawing: bodies with masses and moments of inertia, how they start, the
// forces.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline report::inline drawing {

/// One sentence for each body, or for several that are alike but for their places, and one for each force.
std::vector<std::string> scenario_words(const Scenario& scenario);

}  // namespace polhode::study::report::drawing
