// SPDX-License-Identifier: BSD-3-Clause
// The simulation loop for an ensemble: runs side by side, one in each lane of the SIMD registers. Step size, duration
// and end are each run's own; the lane of a run that has ended passes to the next run.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/run/simulate.hpp"

namespace polhode::inline core::inline run {

/// A run for a lane of an ensemble.
struct LaneRun {
  const System<double>* truth = nullptr;  ///< its system, alone
  Schedule schedule{};                    ///< fixed steps dt, with a sample after every step
};

/// A quantity of the body of each lane, from its motion and its angular momentum about the reference point, world axes.
using LaneQuantity = std::function<Lanes(const BodyMotion<Lanes>&, const Vector3<Lanes>& angular_momentum)>;

/// Consecutive samples of all lanes. Those of vacant lanes, and those after the end of a run, mean nothing.
struct LaneBlock {
  std::span<const LaneSample> samples;
  std::span<const std::span<const Lanes>> watched;  ///< values of each watched quantity, one for each sample
};

/// The sample in one lane.
Sample sample_in(const LaneSample& all, int lane);

/// The states of all lanes at their latest sample. Those of vacant lanes mean nothing.
struct LaneStates {
  const System<Lanes>& system;
  const VectorX<Lanes>& y;
  const LaneSample& sample;
};

/// Observes the runs of an ensemble. Each run is shown as simulate() shows it, but for the samples after the start,
/// which come for all lanes at once.
class EnsembleObserver {
 public:
  virtual ~EnsembleObserver() = default;

  /// The observer of the run in this lane. It receives the initial state, the sample of the start, and states.
  virtual Observer& of_lane(std::size_t lane) = 0;

  /// The observer of the lane has accepted the start of the run.
  virtual void on_begin(std::size_t lane) = 0;

  /// Receives samples. accepted[lane]: the number of samples before the first one that is not finite; 0 for a vacant
  /// lane. If the observer lowers it, the run ends as diverged at the next sample.
  virtual void on_samples(const LaneBlock& block, std::span<const bool> running, std::span<std::size_t> accepted) = 0;

  /// May receive states that observers of lanes are due to receive. due[lane]: the observer of the lane is; if this one
  /// lowers it, that one does not receive the state.
  virtual void on_states(const LaneStates&, std::span<bool> /*due*/) {}

  /// Receives the outcome of the run in this lane, which is vacant then, and the run's share of the time, s.
  virtual void on_end(std::size_t lane, RunOutcome&& outcome, double seconds) = 0;
};

/// The source of the runs of an ensemble, and the functions that carry them out.
struct EnsembleParts {
  /// The next run, for this lane; none: there are no more.
  std::function<std::optional<LaneRun>(std::size_t lane)> next;
  /// Builds the method, which must keep nothing from one step to the next.
  std::function<std::unique_ptr<Integrator<Lanes>>(const System<Lanes>&)> method;
  /// The quantities to be watched, for the problems of all lanes; empty: none.
  std::function<std::vector<LaneQuantity>(std::span<const Problem>)> watched{};
};

/// Carries out runs side by side until there are no more. Their problems must have equal non-empty keys (lane_key),
/// their schedules must agree on `normalize`. Each run gets samples that are bitwise equal to those of simulate(), and
/// ends as under simulate(). `stop`: if given, requests the end of all runs; it is read after every call of the method.
void simulate_ensemble(const EnsembleParts& parts, EnsembleObserver& observer, const std::atomic<bool>* stop = nullptr);

}  // namespace polhode::core::run
