// SPDX-License-Identifier: BSD-3-Clause
// Figures of verdicts as coloured cells: a chart of all methods against the step, and maps over the step and a varied
// key.
#pragma once

#include <string>
#include <vector>

#include "experiments/stability/findings.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::stability {

/// Charts with one row of cells for each method on each motion without varied keys.
std::vector<Figure> stability_charts(const Grouping& grouping, const std::vector<StabilityFinding>& found);

/// Maps of `key` against the step, one panel for each method. `key`: a scenario key with several numbers as values.
std::vector<Figure> stability_maps(const Grouping& grouping, const std::vector<StabilityFinding>& found,
                                   const std::string& key);

}  // namespace polhode::study::stability
