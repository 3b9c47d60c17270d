// SPDX-License-Identifier: BSD-3-Clause
// How far a motion goes: an error of its position means something against that.
#pragma once

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline scenario {

/// m: the largest distance of a moving body's mass centre from its start, at 64 instants of the exact motion up to
/// t_end. Infinite where no path is known exactly, or nothing leaves its place.
double motion_size(const Scenario& scenario, double t_end);

}  // namespace polhode::study
