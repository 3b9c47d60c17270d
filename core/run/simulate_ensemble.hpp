// SPDX-License-Identifier: BSD-3-Clause
// The loop for an ensemble: several runs of one schedule, one in each lane, each with its own observer and its own end.
#pragma once

#include "core/run/simulate.hpp"

namespace polhode {

/// A run in a lane: its system in double, and who watches it.
struct LaneRun {
  const System<double>& truth;
  Observer& observer;
};

/// Runs the systems of `runs`, at most lane_count, which stand in the first lanes of `system` in this order. Each shows
/// its observer the digits that simulate() would show, and ends as it would: a lane that has diverged is looked at no
/// more. The schedule is one of fixed steps, observed after every step.
std::vector<RunOutcome> simulate_ensemble(const System<Lanes>& system, Integrator<Lanes>& integrator,
                                          std::span<const LaneRun> runs, const Schedule& schedule,
                                          const std::atomic<bool>* stop = nullptr);

}  // namespace polhode
