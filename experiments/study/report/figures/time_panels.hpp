// SPDX-License-Identifier: BSD-3-Clause
// Panels of a quantity against time: the largest, the middle and the smallest step of each case side by side.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/study/curves/selection.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

/// A number of the thinned series, signed or a magnitude.
struct SeriesQuantity {
  std::string column;
  std::string axis;  ///< label, with unit
  std::function<double(const SeriesPoint&)> of;
};

bool has_series(const Curve& curve);

/// Rows, each on one y axis; a row has as many panels as steps are shown, at most 3.
std::vector<std::vector<Panel>> panels_against_time(const Selection& selection, const SeriesQuantity& quantity);

}  // namespace polhode::study::report
