// SPDX-License-Identifier: BSD-3-Clause
// What was found of one ladder: measured limits, and those of linear theory where the system is linear.
#pragma once

#include <optional>
#include <vector>

#include "experiments/stability/ladder.hpp"

namespace polhode::study {

/// The step map over a linear system: its spectral radius at every step of the ladder, and where it first exceeds 1.
struct LinearTheory {
  std::vector<std::optional<double>> radius;  ///< of each step of the ladder
  CriticalStep critical;                      ///< to a relative 1e-6
  double smallest = 0, largest = 0;           ///< of the radii
};

struct StabilityFinding {
  Ladder ladder;
  std::optional<double> rate;  ///< rad/s
  CriticalStep growth, blow_up;
  std::optional<LinearTheory> linear;
};

/// A radius of 1 to within this is 1: rounding, and the tolerance of implicit methods.
inline constexpr double radius_tolerance = 1e-9;

std::vector<StabilityFinding> stability_findings(const report::Grouping& grouping);

}  // namespace polhode::study
