// SPDX-License-Identifier: BSD-3-Clause
// Figures of the comparison.
#pragma once

#include <vector>

#include "experiments/methods/ranking.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::methods {

/// Share of the tasks (motion, error) of a group that a method has solved against the budget, a panel a group (as COCO
/// does: Hansen, Auger, Mersmann, Tusar & Brockhoff 2016). `catalogue`: the methods of the study in their order.
Figure solved_against_budget(const Costs& costs, const std::vector<std::string>& catalogue);

/// Performance profile of the best method of each group and the next one: share of the tasks that each solves within a
/// factor of the cheaper of the two. Profiles of more than two methods mislead (Gould & Scott, ACM TOMS 43 (2016) 15).
Figure profiles_of_two(const Costs& costs, const std::vector<std::string>& catalogue);

}  // namespace polhode::study::methods
