// SPDX-License-Identifier: BSD-3-Clause
// A straight line through points by ordinary least squares.
#pragma once

#include <span>

namespace polhode::study::inline statistics {

struct LinePoint {
  double x = 0, y = 0;
};

struct LineFit {
  double slope = 0;
  double standard_error = 0;  ///< standard error of the slope; not a number for two points
  double worst = 0;           ///< largest distance |y − line| of a point
};

/// The line through at least two points with different x; otherwise the slope is not finite.
LineFit fit_line(std::span<const LinePoint> points);

}  // namespace polhode::study::statistics
