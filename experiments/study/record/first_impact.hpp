// SPDX-License-Identifier: BSD-3-Clause
// The run whose first impact replaces the exact one.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline record {

inline constexpr const char* first_impact_method = "odeint_fehlberg78";
inline constexpr double first_impact_tolerance = 1e-13;

/// Its configuration: that method and tolerance with located impacts, in the first formulation; the same for all runs
/// of a motion.
RunConfig first_impact_reference(const RunRecord& run);
bool is_first_impact_reference(const RunConfig& config);

}  // namespace polhode::study::record
