// SPDX-License-Identifier: BSD-3-Clause
// Methods with the smallest and the largest value of a quantity, at the largest and at the smallest step.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

/// One motion in one formulation is described in sentences, a few in a table, and many also in sentences that count
/// over motions and formulations. Methods whose value is at round-off are named together.
struct Extremes {
  std::vector<std::string> sentences;
  std::optional<Table> table;
};
Extremes extremes(const Grouping& grouping, const Quantity& quantity);

/// Indices of the cases all of whose curves in `all` are also in `kept`.
std::set<std::size_t> quiet_cases(const std::vector<const Curve*>& kept, const std::vector<const Curve*>& all);

/// Names of the cases: "peters_hsu and heavy_top"; for many cases "5 of 20 motions".
std::string case_names(const Grouping& grouping, const std::set<std::size_t>& cases);

/// Names of the methods of `some` curves out of `all`: "rk4 and dmv". If `some` contains only a part of a method's
/// curves, that part follows the name: "rk4 (matrix)", "rk4 (heavy_top)", "rk4 (3 of 20 motions)".
std::string method_names(const Grouping& grouping, const std::vector<const Curve*>& some,
                         const std::vector<const Curve*>& all);

}  // namespace polhode::study::report::findings
