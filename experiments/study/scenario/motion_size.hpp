// SPDX-License-Identifier: BSD-3-Clause
// The extent of a motion, which position errors are compared with.
#pragma once

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline scenario {

/// Largest distance (m) of a moving body's mass centre from its start, at 64 instants of the exact motion up to t_end.
/// +inf if no exact path is known, or no body moves.
double motion_size(const Scenario& scenario, double t_end);

}  // namespace polhode::study::scenario
