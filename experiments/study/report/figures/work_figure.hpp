// SPDX-License-Identifier: BSD-3-Clause
// The figure of error against cost.
#pragma once

#include <vector>

#include "experiments/study/curves/work.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

/// Adds to the figure, which has a name, a title and a caption, a panel for each of the first six motions: the error of
/// each run against its cost, with the lower envelope. With more than ten methods, those are grey that are nowhere the
/// cheapest nor the next.
Figure work_figure(const Grouping& grouping, const std::vector<MotionWork>& motions, const RunCost& cost,
                   Figure figure);

}  // namespace polhode::study::report::figures
