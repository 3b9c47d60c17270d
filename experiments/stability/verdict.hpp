// SPDX-License-Identifier: BSD-3-Clause
// What became of the energy of a run: is a step stable?
//
// The signed energy drift over time (RunResult::series) is cut into four quarters of the run; of each the range from
// its lowest to its highest value is taken, and the middle of that range.
#pragma once

#include <optional>
#include <string_view>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::stability {

enum class Verdict {
  stable,          ///< the drift stays within bounds, or below what is counted
  damped,          ///< energy is lost for good
  gaining_slowly,  ///< energy is gained for good, less than `slow` in a turn: a truncation error, no instability
  gaining,         ///< energy is gained for good
  blown_up,        ///< diverged, failed, or a drift of the energy or a defect of the orientation above `lost`
  none             ///< refused: there is no run
};
constexpr std::string_view name(Verdict v) {
  switch (v) {
    case Verdict::stable: return "stable";
    case Verdict::damped: return "damped";
    case Verdict::gaining_slowly: return "gaining slowly";
    case Verdict::gaining: return "gaining";
    case Verdict::blown_up: return "blown up";
    default: return "";
  }
}
/// The energy does not grow, or so slowly that it is no instability.
constexpr bool holds(Verdict v) { return v < Verdict::gaining; }

namespace verdict {
/// A relative drift or an orientation defect above this says no more than that the motion is lost.
inline constexpr double lost = 1000;
/// A relative change of the energy below this is not counted, nor one below 64 ε √steps of the run's arithmetic, nor
/// one that rounding alone explains (RunResult::energy_round_off).
inline constexpr double counted = 1e-9;
/// A trend: the middles of the quarters all move the same way, by this part of the widest range or more.
inline constexpr double trend = 0.5;
/// At rest elsewhere: the middle of the last quarter is this many of its own ranges away from the start.
inline constexpr double settled = 2;
/// A gain is slow: a relative change of less than this for each turn of the run, by the middle of the last quarter and
/// by the least-squares line.
inline constexpr double slow = 0.01;
}  // namespace verdict

/// The verdict on a run. A change is permanent if it is a trend, or if the drift has settled at another value. turn:
/// time unit of slow gains, s; absent: no gain counts as slow, since errors of a linear system grow exponentially,
/// however slowly.
Verdict stability_verdict(const RunRecord& run, std::optional<double> turn = std::nullopt);

/// 1/s, the gain of energy over its scale: slope of the least-squares line through the drift of all samples. Absent for
/// a run that has blown up.
std::optional<double> energy_gain_rate(const RunRecord& run);

}  // namespace polhode::study
