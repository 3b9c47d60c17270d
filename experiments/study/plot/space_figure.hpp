// SPDX-License-Identifier: BSD-3-Clause
// A figure in three dimensions: curves about an ellipsoid or a plane, drawn by gnuplot. What lies behind the ellipsoid
// is dotted.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

using Place = std::array<double, 3>;

struct SpaceCurve {
  std::string label{};
  std::size_t method = 0, variant = 0;  ///< indices as those of PlottedCurve
  std::vector<Place> points{};
};

struct SpaceFigure {
  std::string name, title, caption{};
  std::array<std::string, 3> axes{}, columns{};  ///< labels with units; names in the data file
  std::optional<Place> semi_axes{};              ///< semi-axes of an ellipsoid about the origin, along the axes
  std::optional<double> plane{};                 ///< height of a plane across the third axis
  std::vector<SpaceCurve> curves{};
  std::vector<std::string> methods{}, variants{};  ///< names as those of Figure
  FigureLook look{};
};

/// True if a point on the surface of the ellipsoid is on the side of the viewer.
bool is_in_front(const Place& point, const Place& semi_axes);

std::string space_script(const SpaceFigure& figure);
/// Blocks: the grid of the surface, then for each curve the part in front and the part behind. A line ends at an empty
/// line.
std::string space_data(const SpaceFigure& figure);

}  // namespace polhode::study::plot
