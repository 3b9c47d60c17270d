// SPDX-License-Identifier: BSD-3-Clause
// A panel of curves y(x), for figures that do not show the steps of methods only.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

struct PlainCurve {
  std::string label;
  std::size_t method = 0, variant = 0;  ///< colour and dashes: indices into the figure's methods and variants
  std::vector<std::pair<double, double>> points{};  ///< sorted; x positive if its axis is logarithmic; y not negative
};

/// Name in the data file and label of an axis.
struct PlainAxis {
  std::string column, label;
  Scale scale = Scale::logarithmic;  ///< logarithmic or linear
};

/// A panel; values of exactly zero are drawn at the bottom if y is logarithmic.
Panel plain_panel(std::string title, const PlainAxis& x, const PlainAxis& y, const std::vector<PlainCurve>& curves);

/// Panels below each other, each with its own y axis. All figures of a folder share their colours: give them the same
/// methods.
Figure plain_figure(std::string name, std::string title, std::string caption, std::vector<std::string> methods,
                    std::vector<std::string> variants, std::vector<Panel> panels);

}  // namespace polhode::study::plot
