// SPDX-License-Identifier: BSD-3-Clause
// A panel of curves of one number against another, for figures that are not about the steps of methods alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

struct PlainCurve {
  std::string label;
  std::size_t method = 0, variant = 0;              ///< colour and dashes: indices of the figure's methods and variants
  std::vector<std::pair<double, double>> points{};  ///< x positive, sorted; y 0 or more
};

/// An axis as its column in the data file and its label.
struct PlainAxis {
  std::string column, label;
  Scale scale = Scale::logarithmic;  ///< of y; the x axis is logarithmic
};

/// Values of exactly zero stand at a floor where y is logarithmic.
Panel plain_panel(std::string title, const PlainAxis& x, const PlainAxis& y, const std::vector<PlainCurve>& curves);

/// Panels below each other, each with its own y axis. All figures of a folder share their colours: give them the same
/// methods.
Figure plain_figure(std::string name, std::string title, std::string caption, std::vector<std::string> methods,
                    std::vector<std::string> variants, std::vector<Panel> panels);

}  // namespace polhode::study::report
