// SPDX-License-Identifier: BSD-3-Clause
// Which figures a study has, and what stands in each.
#pragma once

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::report {

/// Those of the analysis first, then those that the study has data for. What would be too much to read is left out, and
/// the caption says so.
FigureSet figures_of(const StudyView& study, const Grouping& grouping);

}  // namespace polhode::study::report
