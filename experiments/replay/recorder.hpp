// SPDX-License-Identifier: BSD-3-Clause
// Carries out runs and stores their motion in memory.
#pragma once

#include "experiments/replay/recording.hpp"
#include "experiments/study/plan/plan.hpp"

namespace polhode::study::replay {

/// Carries out a run and returns at most `most` instants of its motion and as many impacts: each time the limit is
/// reached, every second one is removed.
Recording record(const PlannedRun& run, std::size_t most);

}  // namespace polhode::study::replay
