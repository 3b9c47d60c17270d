// SPDX-License-Identifier: BSD-3-Clause
// Puts panels into the rows of a figure, and says what the marks in them mean.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

/// Puts panels that share a y axis into rows below what the figure has; only the leftmost of a row labels that axis.
void add_rows(Figure& figure, std::vector<Panel> panels, std::size_t columns);

/// Fills in what the legend needs: the methods that are used and the kinds of marks that there are.
void note_marks(Figure& figure);

/// The marks in words, for the caption; after note_marks().
std::string marks_caption(const Figure& figure);

}  // namespace polhode::study::report
