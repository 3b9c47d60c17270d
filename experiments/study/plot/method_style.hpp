// SPDX-License-Identifier: BSD-3-Clause
// Colour, marker and dash of a method, by its name: the same in all figures of all studies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/study/plot/figure_style.hpp"

namespace polhode::study::inline plot {

/// Indices into the tables of figure_style.hpp.
struct MethodStyle {
  std::size_t colour = 0, marker = 0, dash = 0;
  friend bool operator==(const MethodStyle&, const MethodStyle&) = default;
};

/// The style of each name. Two methods of the catalogue share neither colour and marker, nor marker and dash: they are
/// told apart without colour too. Names that the table does not have take the styles that it leaves free, in their
/// order; if it has none of the names (they are no methods), those from the beginning of the table.
std::vector<MethodStyle> styles_of(const std::vector<std::string>& names);

/// "#0072B2"; for pages and windows that show methods in the colours of the figures.
std::string html_colour(const MethodStyle& style);

}  // namespace polhode::study::plot
