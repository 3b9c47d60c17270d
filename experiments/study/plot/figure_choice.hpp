// SPDX-License-Identifier: BSD-3-Clause
// The choice of figures that are drawn, and their look.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

struct FigureChoice {
  std::vector<std::string> names{};  ///< names of the chosen figures; empty: all
  FigureLook look{};
};

/// "one_column", "two_columns" or a number of cm from 5 to 60. Throws InputError, which begins with the label.
double read_figure_width(const std::string& text, const std::string& label);

/// "FAMILY", "FAMILY,SIZE" or ",SIZE", the size in pt from 4 to 40. Throws InputError, which begins with the label.
void read_figure_font(const std::string& text, const std::string& label, FigureLook& look);

/// Removes the figures that are not chosen, and gives the others their look.
void choose_figures(const FigureChoice& choice, std::vector<Figure>& figures);

/// The figure for its width: panels that would be too narrow side by side stand below each other.
Figure fitted(Figure figure);

}  // namespace polhode::study::plot
