// SPDX-License-Identifier: BSD-3-Clause
// The simulation loop for an ensemble: several runs of one schedule, one per lane. Each run has its own observer and
// may end on its own.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/run/simulate.hpp"

namespace polhode {

/// A run in one lane: its system in double and its observer.
struct LaneRun {
  const System<double>& truth;
  Observer& observer;
  /// Receives the values of the watched quantity `which`, one for each sample after the start that the observer has
  /// just accepted. Empty: nobody wants them.
  std::function<void(std::size_t which, std::span<const double> values)> on_watched{};
};

/// A quantity of the body of each lane.
using LaneQuantity = std::function<Lanes(const BodySnapshot<Lanes>&)>;

/// Runs up to lane_count systems side by side. `runs[i]` describes the system in lane i of `system`. Each observer gets
/// samples that are bitwise equal to those of simulate(), and each run ends as under simulate(). A diverged lane gives
/// no more samples. The schedule must have fixed steps dt and a sample after every step. `watched`: quantities that are
/// measured in all lanes at once after every step, in place of a state for each lane.
std::vector<RunOutcome> simulate_ensemble(const System<Lanes>& system, Integrator<Lanes>& integrator,
                                          std::span<const LaneRun> runs, const Schedule& schedule,
                                          const std::atomic<bool>* stop = nullptr,
                                          std::span<const LaneQuantity> watched = {});

}  // namespace polhode
