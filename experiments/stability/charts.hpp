// SPDX-License-Identifier: BSD-3-Clause
// Verdicts as coloured cells: a chart of all methods against the step, and maps over the step and a varied key.
#pragma once

#include <string>
#include <vector>

#include "experiments/stability/findings.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study {

/// One row of cells for each method on each motion without varied keys.
std::vector<report::Figure> stability_charts(const report::Grouping& grouping,
                                             const std::vector<StabilityFinding>& found);

/// One panel for each method, where one key of the scenario takes several numbers: `key` against the step.
std::vector<report::Figure> stability_maps(const report::Grouping& grouping, const std::vector<StabilityFinding>& found,
                                           const std::string& key);

}  // namespace polhode::study
