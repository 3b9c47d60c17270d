// SPDX-License-Identifier: BSD-3-Clause
// A figure as a gnuplot script (for gnuplot 5.4) and its data file. In their folder `gnuplot NAME.gp` draws NAME.svg
// and NAME.pdf.
#pragma once

#include <string>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

inline constexpr const char* style_file = "style.gnuplot";

/// The line styles of the study's methods, which every script loads.
std::string gnuplot_style(const FigureSet& set);

std::string gnuplot_script(const Figure& figure);

/// The data file: columns separated by blanks, one block for each curve, with comments that name them.
std::string gnuplot_data(const Figure& figure);

}  // namespace polhode::study::plot
