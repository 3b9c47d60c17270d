// SPDX-License-Identifier: BSD-3-Clause
// Range and ticks of an axis, from the values on it.
#pragma once

#include <cstddef>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

/// A linear axis from 0 to `high`.
Axis time_axis(double high);

/// A logarithmic axis for steps or tolerances, all positive.
Axis step_axis(std::string label, const std::vector<double>& values);

/// A linear axis from `low` to `high`, with ticks at round numbers.
Axis linear_axis(std::string label, double low, double high);

struct Needs {
  bool floor = false;       ///< room at the bottom, with a tick labelled 0, for values that are exactly zero
  std::size_t crosses = 0;  ///< room at the top for the crosses of so many curves, one above another
};
/// The needs of the points of the panels on a common axis.
Needs needs_of(const std::vector<Panel>& panels);

/// A logarithmic axis for magnitudes; `values` are positive and finite, and may be empty.
Axis log_axis(std::string label, const std::vector<double>& values, Needs needs);
/// Position of the zeros on a log_axis, and of the crosses on any axis (`up`: at the top, otherwise at the bottom).
double floor_of(const Axis& axis);
/// Each curve has a lane of its own, the first at the edge.
double edge_of(const Axis& axis, bool up, std::size_t lane = 0);

/// A symlog axis for signed values. `smallest_curve`: the smallest of the curves' largest magnitudes (0: all are zero).
/// The threshold is a hundredth of it, rounded to a power of ten, and at least 1e-16, so that the smallest curve is
/// visible.
Axis symlog_axis(std::string label, double lowest, double highest, double smallest_curve);

/// Every how manyth tick of an axis of this length has its label, so that labels of this width stand apart.
std::size_t labels_apart(const Axis& axis, double length, double width);

/// Gives panels one common y axis and places their points on it; the crosses of each curve in a lane of their own.
void share_y_axis(std::vector<Panel>& panels, const Axis& axis);

}  // namespace polhode::study::plot
