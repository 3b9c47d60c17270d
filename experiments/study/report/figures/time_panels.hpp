// SPDX-License-Identifier: BSD-3-Clause
// Panels of a quantity against time, side by side for the largest, the middle and the smallest step of each case.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/study/curves/selection.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

/// A quantity of the thinned history of a run, signed or a magnitude.
struct SeriesQuantity {
  std::string column;
  std::string axis;  ///< label, with unit
  std::function<double(const SeriesPoint&)> of;
};

bool has_series(const Curve& curve);

/// Rows of panels with a common y axis in each row; one panel for each step shown, at most 3.
std::vector<std::vector<Panel>> panels_against_time(const Selection& selection, const SeriesQuantity& quantity);

}  // namespace polhode::study::report::figures
