// SPDX-License-Identifier: BSD-3-Clause
// Carries out runs and keeps their motion in memory.
#pragma once

#include "experiments/replay/recording.hpp"
#include "experiments/study/plan/plan.hpp"

namespace polhode::study::replay {

/// The run with at most `most` instants of its motion and as many impacts: where there are more, every second one is
/// left out, and so on. The scenario is the run's own.
Recording record(const PlannedRun& run, std::size_t most);

}  // namespace polhode::study
