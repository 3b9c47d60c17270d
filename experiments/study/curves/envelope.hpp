// SPDX-License-Identifier: BSD-3-Clause
// Lower envelope of work-precision curves: the method that reaches an error at the least cost, at each decade of error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline curves {

struct WorkPoint {
  double error = 0;                ///< a point whose error is not positive and finite is ignored
  double cost = 0;                 ///< evaluations of the right-hand side or s; ignored likewise
  const RunRecord* run = nullptr;  ///< the run that is this point, if it is known
};

/// Least cost at which a curve reaches `error`: interpolated linearly in the logarithms between two runs. Not
/// extrapolated: if the cheapest run already has a smaller error, the cost of that run. Absent if no run reaches it.
std::optional<double> cost_to_reach(double error, const std::vector<WorkPoint>& curve);

struct EnvelopePoint {
  int decade = 0;         ///< error = 10^decade
  std::size_t curve = 0;  ///< index of the cheapest curve, the first one of equals
  double cost = 0;
  bool at_most = false;  ///< upper bound: the cheapest run has a smaller error, a larger step may be cheaper
  std::optional<std::size_t> next{};  ///< index of the second cheapest curve
  double next_cost = 0;
};

/// The envelope at each decade between the smallest and the largest error of the curves, in descending order. Errors
/// above `lost` are ignored, as the motion is lost.
std::vector<EnvelopePoint> lower_envelope(const std::vector<std::vector<WorkPoint>>& curves, double lost);

}  // namespace polhode::study::curves
