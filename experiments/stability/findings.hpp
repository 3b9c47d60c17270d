// SPDX-License-Identifier: BSD-3-Clause
// Findings about one ladder of steps: measured limits and, for a linear system, those of linear theory.
#pragma once

#include <optional>
#include <vector>

#include "experiments/stability/step_ladder.hpp"

namespace polhode::study::stability {

/// Step map of a linear system: its spectral radius at every step of the ladder, and the step at which it first
/// exceeds 1.
struct LinearTheory {
  std::vector<std::optional<double>> radius;  ///< spectral radius at each step of the ladder
  CriticalStep critical;                      ///< critical step, bracketed to a relative width of 1e-6
  double smallest = 0, largest = 0;           ///< smallest and largest spectral radius
};

/// Rate of change of the energy at steps at which the energy does not grow and the motion is followed.
struct EnergyGain {
  double dt = 0;                                    ///< largest such step, or the smallest step of all, s
  double per_second = 0;                            ///< rate over the energy scale, signed, 1/s
  double smallest_dt = 0, smallest_per_second = 0;  ///< the same for the smallest step at which it was measured
  std::optional<double> exponent{};                 ///< p of gain ∝ step^p, if it is known to ±0.25
};

struct StabilityFinding {
  Ladder ladder;
  std::optional<double> rate;  ///< characteristic rate of the motion, rad/s
  CriticalStep growth, blow_up, motion;
  Lost lost = Lost::nothing;  ///< quantity that is lost at the step motion.fails
  /// Verdict on the steps below growth.fails at which the motion is followed; if there is none, on the smallest step.
  Verdict below = Verdict::none;
  std::optional<EnergyGain> gain{};  ///< change of the energy; absent if `below` is neither damped nor a gain
  std::optional<LinearTheory> linear;
};

/// Largest excess of a spectral radius over 1 that counts as 1: it covers rounding and the tolerance of implicit
/// methods.
inline constexpr double radius_tolerance = 1e-9;

std::vector<StabilityFinding> stability_findings(const Grouping& grouping);

}  // namespace polhode::study::stability
