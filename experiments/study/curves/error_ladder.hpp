// SPDX-License-Identifier: BSD-3-Clause
// Converts a curve to a ladder for the estimate of its order; the only place that decides which errors are fitted.
//
// An error is fitted if the run was completed, the error is finite, it is below half the level at which the motion is
// lost (lost_level() in curves.hpp), and rounding is less than a tenth of it. Rounding: the largest of
// round_off_level() in curves.hpp, the floor visible in the ladder itself, and the uncertainty of a reference. The
// errors that are left must fall along a straight line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::inline curves {

/// Errors of the runs against their steps or tolerances, without refused runs. The error is +inf if it is too large for
/// a fit or the run was not completed. The round-off is +inf if a reference proves no digit of the error.
std::vector<LadderPoint> error_ladder(const Curve& curve, const Quantity& quantity);

/// The order of the error_ladder() of the curve (statistics/order_estimate.hpp).
OrderEstimate observed_order(const Curve& curve, const Quantity& quantity);

/// The fitted line if it is conclusive: straight, with an interval of the order of at most ±0.5. Only such an order
/// appears in reports.
std::optional<OrderEstimate::Line> told_line(const OrderEstimate& estimate);

/// Reason why a curve has no order: "errors at round-off", "steps too large: the attitude is off by more than half a
/// radian".
std::string why_not_told(const Curve& curve, const Quantity& quantity, const OrderEstimate& estimate);

}  // namespace polhode::study::curves
