// SPDX-License-Identifier: BSD-3-Clause
// What became of the energy of a run: is a step stable?
//
// The signed energy drift over time (RunResult::series) is cut into four quarters of the run; of each the range from its
// lowest to its highest value is taken, and the middle of that range.
#pragma once

#include <string_view>

#include "experiments/study/run_record.hpp"

namespace polhode::study {

enum class Verdict {
  stable,    ///< the drift stays within bounds, or below what is counted
  damped,    ///< energy is lost for good
  gaining,   ///< energy is gained for good
  blown_up,  ///< diverged, failed, or a drift above `lost`
  none       ///< refused: there is no run
};
constexpr std::string_view name(Verdict v) {
  switch (v) {
    case Verdict::stable: return "stable";
    case Verdict::damped: return "damped";
    case Verdict::gaining: return "gaining";
    case Verdict::blown_up: return "blown up";
    default: return "";
  }
}
/// Stable or damped: errors of the start do not grow.
constexpr bool holds(Verdict v) { return v == Verdict::stable || v == Verdict::damped; }

namespace verdict {
/// A relative drift above this says no more than that the motion is lost.
inline constexpr double lost = 1000;
/// A change of the energy below this is not counted, nor one below 64 ε √steps of the run's arithmetic.
inline constexpr double counted = 1e-9;
/// A trend: the middles of the quarters all move the same way, by this part of the widest range or more.
inline constexpr double trend = 0.5;
/// At rest elsewhere: the middle of the last quarter is this many of its own ranges away from the start.
inline constexpr double settled = 2;
}  // namespace verdict

/// By the series and the status alone. A trend, or having come to rest elsewhere, is a change for good.
Verdict judge(const RunRecord& run);

}  // namespace polhode::study
