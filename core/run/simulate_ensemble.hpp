// SPDX-License-Identifier: BSD-3-Clause
// The simulation loop for an ensemble: several runs of one schedule, one per lane. Each run has its own observer and
// may end on its own.
#pragma once

#include "core/run/simulate.hpp"

namespace polhode {

/// A run in one lane: its system in double and its observer.
struct LaneRun {
  const System<double>& truth;
  Observer& observer;
};

/// Runs up to lane_count systems side by side. `runs[i]` describes the system in lane i of `system`. Each observer gets
/// samples that are bitwise equal to those of simulate(), and each run ends as under simulate(). A diverged lane gives
/// no more samples. The schedule must have fixed steps dt and a sample after every step.
std::vector<RunOutcome> simulate_ensemble(const System<Lanes>& system, Integrator<Lanes>& integrator,
                                          std::span<const LaneRun> runs, const Schedule& schedule,
                                          const std::atomic<bool>* stop = nullptr);

}  // namespace polhode
