// SPDX-License-Identifier: BSD-3-Clause
// Which figures a study has, and what stands in each.
#pragma once

#include <string>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

/// Those of the analysis first, then those that the study has data for. What would be too much to read is left out, and
/// the caption says so.
FigureSet figures_of(const StudyView& study, const Grouping& grouping);

/// Writes the folder figures/: for each figure SVG and PDF by gnuplot, the .gp script, the data and a PGFPlots .tex.
/// Writes figures that the analysis made from wall times to timings/ in the same way. Throws std::runtime_error if
/// gnuplot fails. If gnuplot is not installed, scripts and data are still written, and a message is returned (empty:
/// all figures were made).
std::string write_figures(const StudyView& study);

}  // namespace polhode::study::report::figures
