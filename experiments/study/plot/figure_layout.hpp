// SPDX-License-Identifier: BSD-3-Clause
// Arranges panels in rows of a figure, and describes their marks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

/// Appends panels that share a y axis as rows; only the leftmost panel of a row labels that axis.
void add_rows(Figure& figure, std::vector<Panel> panels, std::size_t columns);

/// Sets the contents of the legend: the methods that are used and the kinds of marks; and the names beside crosses.
/// Call after the figure has its methods, and its panels their axes.
void note_marks(Figure& figure);

/// The marks in words, for the caption; call after note_marks().
std::string marks_caption(const Figure& figure);

}  // namespace polhode::study::plot
