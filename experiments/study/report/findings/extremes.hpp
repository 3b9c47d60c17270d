// SPDX-License-Identifier: BSD-3-Clause
// Which method has the least and which the most of a quantity, at the largest and at the smallest step.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

/// Of one motion in one formulation: sentences. Of a few: a table. Of many: sentences that count over them as well.
/// Methods whose value is at round-off are named together.
struct Extremes {
  std::vector<std::string> sentences;
  std::optional<Table> table;
};
Extremes extremes(const Grouping& grouping, const Quantity& quantity);

/// The cases in which all of these curves are among the kept ones.
std::set<std::size_t> quiet_cases(const std::vector<const Curve*>& kept, const std::vector<const Curve*>& all);

/// "peters_hsu and heavy_top"; of many "5 of 20 motions".
std::string case_names(const Grouping& grouping, const std::set<std::size_t>& cases);

/// Names of the methods of `some` curves out of `all`: "rk4 and dmv". Where only a part of a method's curves is among
/// them the name says which: "rk4 (matrix)", "rk4 (heavy_top)", "rk4 (3 of 20 motions)".
std::string method_names(const Grouping& grouping, const std::vector<const Curve*>& some,
                         const std::vector<const Curve*>& all);

}  // namespace polhode::study::report
