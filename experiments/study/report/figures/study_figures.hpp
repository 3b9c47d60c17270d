// SPDX-License-Identifier: BSD-3-Clause
// Selection of the figures of a study, and the contents of each.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

/// Name of the figure that shows the answer of a study without an analysis.
inline constexpr const char* figure_of_the_answer = "error_against_cost";

/// The figures: first those of the analysis, then each figure for which the study has data. Curves and panels beyond a
/// readable number are left out, which the caption states.
FigureSet figures_of(const StudyView& study, const Grouping& grouping);

/// Writes the folder figures/: for each figure SVG and PDF by gnuplot, the .gp script, the data and a PGFPlots .tex.
/// Writes figures that the analysis made from wall times to timings/ in the same way. Throws std::runtime_error if
/// gnuplot fails. If gnuplot is not installed, scripts and data are still written, and a message is returned, as
/// of figures that were chosen and that the study does not have (empty: all figures were made).
std::string write_figures(const StudyView& study);

struct RedrawnFigures {
  std::vector<std::string> names;   ///< figures that were drawn
  std::vector<std::string> others;  ///< figures in the folder that were not drawn, unless --figure chose some
  std::string said;                 ///< result of write_figures()
};
/// Writes the figures of stored runs, without an analysis, among those that are in figures/.
RedrawnFigures redraw_figures(const StudyView& study);

}  // namespace polhode::study::report::figures
