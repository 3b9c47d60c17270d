// SPDX-License-Identifier: BSD-3-Clause
// Runs that conserve the energy but not the angular momentum, in particular those without the gyroscopic term. The
// energy drift does not reveal their error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

/// Warnings: one for each motion and formulation with runs whose energy is conserved but whose angular momentum is not,
/// and one for runs without the gyroscopic term of motions without a conserved angular momentum.
std::vector<std::string> cautions(const Grouping& grouping);

/// Comparison of runs with and without the gyroscopic term, at the smallest step that both completed.
struct GyroscopicComparison {
  Table table;
  bool differs = false;  ///< any number in the table differs in a digit that is shown
};
/// The comparison; absent if the study has no such pair of runs.
std::optional<GyroscopicComparison> gyroscopic_comparison(const Grouping& grouping);

}  // namespace polhode::study::report::findings
