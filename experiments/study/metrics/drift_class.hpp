// SPDX-License-Identifier: BSD-3-Clause
// The class of an energy drift: what can be said of its growth, and what cannot.
//
//   round-off    it never passes what rounding alone can have added up to
//   jumps        it changes at impacts, and not between them
//   saturated    it has come to rest at a value of its own, or does not grow at a size of the energy's scale
//   bounded      whatever goes one way stays small beside the oscillation, which does not grow either
//   random walk  p = ½ of a drift as often up as down, spread evenly over the run
//   sublinear, linear, quadratic, faster: p of a drift that goes one way
//   undecided    everything else
// A class by its exponent needs the whole 95 % interval; growth needs to stand clearly above rounding, to be seen
// beside the oscillations that were taken out, and no oscillation slow enough to look like it. Growth and its interval
// are those of drift_growth.hpp.
//
// An undecided drift has the duration that would decide, where one can be told:
//   too few samples: the one that has 32 of them;
//   a slow oscillation: six of its periods; a change over the whole run counts as one of 1.5 periods in it;
//   too wide an interval of p: the one of half width 0.2, since it shrinks as t^−(p + ½), the growth over √t of its
//   noise; a sudden rise, of p beyond 5, that may be a pulse: twice the run; growth that may hide in noise: the one at
//   which its limit is small, since that shrinks as t^−½.
// None is told beyond a thousand runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/statistics/drift_growth.hpp"

namespace polhode::study::inline metrics {

struct DriftRecord {
  std::vector<BlockMean> blocks;  ///< J
  double largest = 0;             ///< J, the largest |drift|, which the means do not show
  double largest_early = 0;       ///< J, in the first half of the run
  double round_off = 0;           ///< J, what rounding alone can have added up to by the end of the run
  double scale = 0;               ///< J, of the energy
  std::int64_t samples = 0;
  double t_end = 0;             ///< s
  std::vector<double> impacts;  ///< s, in order; may be thinned
};

struct DriftClass {
  std::string name;
  std::optional<double> exponent, low, high;  ///< of bounded (0), random walk, sublinear … faster
  std::optional<double> slope_half_width;     ///< W, 95 %
  std::optional<double> decided_after;        ///< s, of undecided
};

DriftClass classify(const DriftRecord& record);

}  // namespace polhode::study
