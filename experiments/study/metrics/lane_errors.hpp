// SPDX-License-Identifier: BSD-3-Clause
// Errors against the exact motions of free tops, for a drift meter in each lane: measured in all lanes at once, with
// the digits of a meter alone.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/exact/free_tops.hpp"
#include "core/run/simulate_ensemble.hpp"
#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/metrics/polhode_errors.hpp"

namespace polhode::study::inline metrics {

class LaneErrors {
 public:
  /// The meter takes the place of the one in this lane. The start of its run has been measured. Its errors are measured
  /// here if its body is a free top whose ω varies.
  void begin(std::size_t lane, DriftMeter& meter);

  /// Measures the errors in the lanes that are due, and lowers `due` there; other lanes stay due. So do all where few
  /// are due: their meters are as quick alone.
  void measure(const LaneStates& states, std::span<bool> due);

  /// Gives the meter of the lane what was measured. To be called once, after the run.
  void end(std::size_t lane);

 private:
  static constexpr auto count = std::size_t(lane_count);
  static constexpr int fewest = 3;  ///< smallest number of lanes that cost less together than alone

  /// The lane goes on from the errors of its meter, or the meter from those of the lane.
  void take(std::size_t lane);
  void give(std::size_t lane);

  std::array<DriftMeter*, count> meters_{};  ///< null: the errors of the lane are not measured here
  std::array<bool, count> alone_{};          ///< the meter has measured last, not the lane
  bool any_before_ = false;                  ///< a lane has had a meter
  FreeTops tops_;
  PolhodeErrors polhode_;
  Lanes speed_scale_ = 1;  ///< rad/s
  // The largest errors, as in DriftMeter.
  Lanes position_ = 0, attitude_ = 0, angular_velocity_ = 0;
  Lanes phase_ = 0, phase_rad_ = 0, off_ = 0;
};

}  // namespace polhode::study::metrics
