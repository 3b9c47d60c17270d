// SPDX-License-Identifier: BSD-3-Clause
// Tables and CSV files of the comparison.
#pragma once

#include <string>

#include "experiments/methods/ranking.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::methods {

/// Costs within this factor of each other are a tie.
inline constexpr double tie = 1.2;

/// The error for which a page names one method: 1e-6.
inline constexpr std::size_t usual_target = 4;

bool anyone(std::size_t contender);
/// Contenders with a fixed step.
ContenderTest fixed_steps(const Costs& costs);
/// Contenders whose energy is bounded on every problem of a group that they follow, and on one at least.
ContenderTest bounded_energy(const Costs& costs, std::size_t group);

/// "rk4 (quaternion, velocity_body)".
std::string label(const Contender& contender);

/// The recommended contender among the allowed, its mean cost, and the runner-up, for each group and the errors 1e-3,
/// 1e-6 and 1e-9.
Table recommended(const Costs& costs, const std::string& caption,
                  const std::function<ContenderTest(std::size_t group)>& allowed);

/// A row for each group: the recommended methods for these errors.
Table in_short(const Costs& costs);

/// The cheapest method for each problem and error; two names where the second costs at most 20 % more.
Table cheapest(const Costs& costs);

/// The method that is best over all errors in each group, against the others, in pairs.
Table duels(const Costs& costs, std::size_t opponents);

/// The cost of the recommendation of each group on a problem that is not used for it.
Table robustness(const Costs& costs);

/// The methods that do not reach an error of 1e-2 on a problem, and why.
Table failures(const Costs& costs);

std::string recommended_csv(const Costs& costs);  ///< every group and error
std::string pairs_csv(const Costs& costs);        ///< every pair of methods in every group
std::string regret_csv(const Costs& costs);

}  // namespace polhode::study::methods
