// SPDX-License-Identifier: BSD-3-Clause
// A figure as a gnuplot script (for gnuplot 5.4) and its data file. In their folder `gnuplot NAME.gp` draws NAME.svg
// and NAME.pdf.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

inline constexpr const char* style_file = "style.gnuplot";

/// The line styles of the methods of all figures, which every script loads.
std::string gnuplot_style(const FigureSet& set);

/// Number of line styles before those of each figure. Figures of the same methods share theirs.
std::vector<std::size_t> first_styles(const FigureSet& set);

std::string gnuplot_script(const Figure& figure, std::size_t first_style = 0);

/// The data file: columns separated by blanks, one block for each curve, with comments that name them.
std::string gnuplot_data(const Figure& figure);

}  // namespace polhode::study::plot
