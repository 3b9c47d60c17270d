// SPDX-License-Identifier: BSD-3-Clause
// What was found of one ladder: measured limits, and those of linear theory where the system is linear.
#pragma once

#include <optional>
#include <vector>

#include "experiments/stability/step_ladder.hpp"

namespace polhode::study::stability {

/// The step map over a linear system: its spectral radius at every step of the ladder, and where it first exceeds 1.
struct LinearTheory {
  std::vector<std::optional<double>> radius;  ///< of each step of the ladder
  CriticalStep critical;                      ///< to a relative 1e-6
  double smallest = 0, largest = 0;           ///< of the radii
};

/// How fast the energy changes where it does not grow and the motion is followed.
struct EnergyGain {
  double dt = 0;                                    ///< s, the largest such step, or the smallest step of all
  double per_second = 0;                            ///< over the energy scale, signed
  double smallest_dt = 0, smallest_per_second = 0;  ///< the same of the smallest step at which it was seen
  std::optional<double> exponent{};                 ///< p of gain ∝ step^p, where the steps tell it to ±0.25
};

struct StabilityFinding {
  Ladder ladder;
  std::optional<double> rate;  ///< rad/s
  CriticalStep growth, blow_up, motion;
  Lost lost = Lost::nothing;      ///< at motion.fails
  Verdict below = Verdict::none;  ///< of the steps below growth.fails at which the motion is followed; where there is
                                  ///< none, of the smallest
  std::optional<EnergyGain> gain{};  ///< absent where `below` is neither damped nor a gain
  std::optional<LinearTheory> linear;
};

/// A radius of 1 to within this is 1: rounding, and the tolerance of implicit methods.
inline constexpr double radius_tolerance = 1e-9;

std::vector<StabilityFinding> stability_findings(const Grouping& grouping);

}  // namespace polhode::study
