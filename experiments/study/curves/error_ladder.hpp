// SPDX-License-Identifier: BSD-3-Clause
// A curve as a ladder for the estimate of its order: the one place that says which errors tell an order.
//
// An error tells an order where the run ended, the error is finite, it is below half the level at which the motion is
// lost (lost_level(): an attitude off by a radian is wrapped or saturated), and rounding is less than a tenth of it
// (round_off_level(), the floor that the ladder itself shows, and the digits that a reference proves). What is left
// must fall along a straight line.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::inline curves {

/// The errors of its runs against their steps or tolerances, without refused ones; infinite where it is too large for
/// a fit or the run did not end. An error that a reference proves no digit of has an infinite round-off.
std::vector<LadderPoint> error_ladder(const Curve& curve, const Quantity& quantity);

OrderEstimate observed_order(const Curve& curve, const Quantity& quantity);

/// A line that says something: straight, with an interval of ±0.5 at most.
std::optional<OrderEstimate::Line> told_line(const OrderEstimate& estimate);

/// Why a curve tells no order: "errors at round-off", "steps too large: the attitude is off by more than half a
/// radian".
std::string why_not_told(const Curve& curve, const Quantity& quantity, const OrderEstimate& estimate);

}  // namespace polhode::study::report
