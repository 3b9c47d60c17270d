// SPDX-License-Identifier: BSD-3-Clause
// Which figures a study has, and what stands in each.
#pragma once

#include <array>

#include "experiments/study/report/curves.hpp"
#include "experiments/study/report/figure.hpp"

namespace polhode::study::report {

/// The names of all figures that a study may have.
inline constexpr std::array figure_names = {"drift_against_time", "drift_against_step", "momentum",
                                            "orientation_defect", "invariants",         "error_against_step"};

/// Those that the study has data for. What would be too much to read is left out, and the caption says so.
FigureSet figures_of(const StudyView& study, const Grouping& grouping);

}  // namespace polhode::study::report
