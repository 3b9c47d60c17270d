// SPDX-License-Identifier: BSD-3-Clause
// A curve as a ladder for the estimate of its order.
#pragma once

#include <vector>

#include "experiments/study/order_estimate.hpp"
#include "experiments/study/report/curves.hpp"

namespace polhode::study::report {

/// The errors of its runs against their steps or tolerances, without refused ones; not finite where a run did not end.
std::vector<LadderPoint> error_ladder(const Curve& curve, const Quantity& quantity);

}  // namespace polhode::study::report
