// SPDX-License-Identifier: BSD-3-Clause
// Verdict on the energy of a run, which decides whether a step is stable.
//
// The signed energy drift over time (RunResult::series) is divided into four quarters of the run. Each quarter is
// characterised by the range from its lowest to its highest value, and by the middle of that range.
#pragma once

#include <optional>
#include <string_view>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::stability {

enum class Verdict {
  stable,          ///< the drift is bounded, or too small to be counted
  damped,          ///< permanent loss of energy
  gaining_slowly,  ///< permanent gain of energy, less than `slow` per turn: a truncation error, no instability
  gaining,         ///< permanent gain of energy
  blown_up,        ///< the run diverged or failed, or its energy drift or orientation defect exceeds `lost`
  none             ///< the run was refused
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
/// True if the energy does not grow, or so slowly that it is no instability.
constexpr bool holds(Verdict v) { return v < Verdict::gaining; }

namespace verdict {
/// Relative energy drift or orientation defect above which the verdict is blown_up.
inline constexpr double lost = 1000;
/// Smallest relative change of the energy that counts. It must also exceed 64 ε √steps of the run's arithmetic, and the
/// largest change that rounding alone explains (RunResult::energy_round_off).
inline constexpr double counted = 1e-9;
/// Smallest change of a trend over the widest range of a quarter. In a trend the middles of the quarters all move in
/// the same direction.
inline constexpr double trend = 0.5;
/// Smallest distance of the middle of the last quarter from 0, over the width of its range, of a drift that has settled
/// at another value.
inline constexpr double settled = 2;
/// Largest relative change of the energy per turn of a slow gain, both by the permanent change and by the least-squares
/// line.
inline constexpr double slow = 0.01;
}  // namespace verdict

/// The verdict on a run. A change is permanent if it is a trend, or if the drift has settled at another value. turn:
/// time unit of slow gains, s; absent: no gain counts as slow, since errors of a linear system grow exponentially,
/// however slowly.
Verdict stability_verdict(const RunRecord& run, std::optional<double> turn = std::nullopt);

/// Rate of energy gain over the energy scale: slope of the least-squares line through the drift of all samples, 1/s.
/// Absent for a run that has blown up.
std::optional<double> energy_gain_rate(const RunRecord& run);

}  // namespace polhode::study::stability
