// SPDX-License-Identifier: BSD-3-Clause
// What energy alone does not show: runs that keep the energy and lose the angular momentum, above all those in which
// the gyroscopic term is left out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

/// A caution for each motion and formulation in which the energy would call a run perfect and the angular momentum does
/// not; and one where the gyroscopic term is left out but no angular momentum is conserved that could show it.
std::vector<std::string> cautions(const Grouping& grouping);

/// The same runs with the gyroscopic term and without it, at the smallest step that both completed.
struct GyroscopicComparison {
  Table table;
  bool differs = false;  ///< in any digit shown
};
/// Absent where the study has no such pair.
std::optional<GyroscopicComparison> gyroscopic_comparison(const Grouping& grouping);

}  // namespace polhode::study::report
