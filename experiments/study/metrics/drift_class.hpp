// SPDX-License-Identifier: BSD-3-Clause
// Class of an energy drift by its growth |drift| ~ t^p:
//
//   round-off    never larger than rounding alone can explain
//   jumps        changes at impacts, and not between them
//   saturated    settled at a value other than 0, or stopped growing at the size of the energy scale
//   bounded      oscillation without growth; any trend is small beside it
//   random walk  no trend, p = ½, spread evenly over the run
//   sublinear, linear, quadratic, faster
//                trend of p in 0.25 … 0.75, 0.75 … 1.5, 1.5 … 2.5, above 2.5
//   undecided    everything else
//
// A class with an exponent requires the whole 95 % interval of p to lie in its range. Growth must exceed rounding
// clearly and exceed the uncertainty of the oscillations that were subtracted, and there must be no oscillation slow
// enough to be mistaken for growth. Growth and its interval: drift_growth.hpp.
//
// For an undecided drift, the duration of a run that would decide is estimated:
//   too few samples        the duration with 32 samples
//   a slow oscillation     six of its periods; a change over the whole run counts as 1.5 periods
//   interval of p too wide the duration with a half width of 0.2; the width shrinks as t^−(p + ½): growth increases
//                          as t^p, averaged noise decreases as t^−½
//   a sudden rise          twice the run, as it may be a pulse (p + half width above 5)
//   growth hidden in noise the duration at which the limit of growth is small; that limit shrinks as t^−½
// No duration above 1000 times that of the run is given.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/statistics/drift_growth.hpp"

namespace polhode::study::inline metrics {

struct DriftRecord {
  std::vector<BlockMean> blocks;  ///< means of the drift, J
  double largest = 0;             ///< largest |drift| of all samples, J
  double largest_early = 0;       ///< largest |drift| in the first half of the run, J
  double round_off = 0;           ///< largest drift that rounding alone can explain at the end of the run, J
  double scale = 0;               ///< energy scale of the motion, J
  std::int64_t samples = 0;
  double t_end = 0;             ///< duration of the run, s
  std::vector<double> impacts;  ///< times of impacts in ascending order, s; may be thinned
};

struct DriftClass {
  std::string name;
  /// Exponent p and its 95 % interval; absent for round-off, jumps, saturated and undecided, 0 for bounded.
  std::optional<double> exponent, low, high;
  std::optional<double> slope_half_width;  ///< half the 95 % interval of the slope of the drift, W
  std::optional<double> decided_after;     ///< estimated duration that would decide, s; undecided only
};

/// Classifies the drift of one run.
DriftClass classify(const DriftRecord& record);

}  // namespace polhode::study::metrics
