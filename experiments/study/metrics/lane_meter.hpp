// SPDX-License-Identifier: BSD-3-Clause
// Drift meters for the runs of an ensemble, one in each lane. What is measured at every sample is measured in all lanes
// at once, with the digits of a meter alone.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/run/simulate_ensemble.hpp"
#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/metrics/drift_sums.hpp"
#include "experiments/study/metrics/lane_errors.hpp"

namespace polhode::study::inline metrics {

class LaneMeter {
 public:
  /// The meter takes the place of the one in this lane. The start of its run has been measured.
  void begin(std::size_t lane, DriftMeter& meter);

  /// Takes samples as EnsembleObserver::on_samples() does. The watched quantities are the invariants of the runs, in
  /// their order.
  void on_samples(const LaneBlock& block, std::span<const bool> running, std::span<std::size_t> accepted);

  /// Measures errors as EnsembleObserver::on_states() receives states: where the exact motion is that of a free top.
  void on_states(const LaneStates& states, std::span<bool> due) { errors_.measure(states, due); }

  /// Gives the meter of the lane what was measured. To be called once, after the run.
  void end(std::size_t lane);

 private:
  static constexpr auto count = std::size_t(lane_count);

  void follow(const std::array<std::size_t, count>& seen, std::size_t n);
  void add_to_curves(const std::array<std::size_t, count>& seen, std::size_t n);
  void end_within(const LaneBlock& block, std::size_t lane, std::size_t seen, std::size_t accepted);

  std::array<DriftMeter*, count> meters_{};
  std::array<bool, count> holds_{};  ///< sums of the lane are here, and not in its meter
  DriftOrigin<Lanes> origin_;
  DriftSums<Lanes> sums_;
  std::vector<Lanes> starts_, worst_;  ///< start values and largest changes of the invariants
  DriftColumns<Lanes> columns_;
  LaneErrors errors_;
};

}  // namespace polhode::study::metrics
