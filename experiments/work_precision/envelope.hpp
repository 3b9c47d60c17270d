// SPDX-License-Identifier: BSD-3-Clause
// The lower envelope of work-precision curves: which method reaches an error at the least cost, at each decade of
// error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace polhode::study::work_precision {

struct WorkPoint {
  double error = 0;  ///< not finite or not positive: the point is left out
  double cost = 0;   ///< right-hand sides or seconds; likewise
};

/// The cost at which a curve first reaches `error` as its cost rises: between two runs on the straight line of the
/// logarithms. Never extrapolated: where its cheapest run is better than that already, the cost of that run; nothing
/// where no run is as good.
std::optional<double> cost_to_reach(double error, const std::vector<WorkPoint>& curve);

struct EnvelopePoint {
  int decade = 0;         ///< error = 10^decade
  std::size_t curve = 0;  ///< the cheapest; of equals the first
  double cost = 0;
  bool at_most = false;               ///< its cheapest run is better than this error: a larger step may be cheaper yet
  std::optional<std::size_t> next{};  ///< the curve that comes second
  double next_cost = 0;
};

/// At each decade from the best to the worst error that some curve reaches, largest first. Errors above `lost` say that
/// a motion is lost and count for nothing.
std::vector<EnvelopePoint> lower_envelope(const std::vector<std::vector<WorkPoint>>& curves, double lost);

}  // namespace polhode::study
