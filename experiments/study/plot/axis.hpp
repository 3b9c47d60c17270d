// SPDX-License-Identifier: BSD-3-Clause
// The range and the ticks of an axis, from the values that stand on it.
#pragma once

#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

/// From 0 to `high`.
Axis time_axis(double high);

/// Of steps or tolerances, all positive.
Axis step_axis(std::string label, const std::vector<double>& values);

/// Of any numbers from `low` to `high`, with ticks at round ones.
Axis linear_axis(std::string label, double low, double high);

struct Needs {
  bool floor = false;  ///< room at the bottom, and a tick labelled 0, for values that are exactly zero
  bool edge = false;   ///< room at the top for crosses
};
/// Of magnitudes; `values` positive and finite, perhaps none.
Axis log_axis(std::string label, const std::vector<double>& values, Needs needs);
/// Where the zeros of a log_axis stand, and the crosses of any axis (`up`: at its top, otherwise at its bottom).
double floor_of(const Axis& axis);
double edge_of(const Axis& axis, bool up);

/// Of signed values; `smallest_curve` is the smallest of the curves' largest magnitudes (0: all are zero). The
/// threshold is a hundredth of it, as a power of ten, so that the quietest curve can be told from zero; never below
/// 1e-16.
Axis symlog_axis(std::string label, double lowest, double highest, double smallest_curve);

/// Gives panels one y axis and puts their points on it.
void share_y_axis(std::vector<Panel>& panels, const Axis& axis);

}  // namespace polhode::study::report
