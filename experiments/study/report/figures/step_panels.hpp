// SPDX-License-Identifier: BSD-3-Clause
// Panels of a quantity against the step, or against the tolerance of adaptive methods; both axes logarithmic.
#pragma once

#include <vector>

#include "experiments/study/curves/selection.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

bool has_several_steps(const Curve& curve);
bool has_value(const Curve& curve, const Quantity& quantity);
/// A value, or a run that ended early and so has a cross.
bool has_mark(const Curve& curve, const Quantity& quantity);

/// All on one y axis, without panels in which everything is exactly zero; with `guides`, gray lines of slope 1, 2
/// and 4.
std::vector<Panel> panels_against_step(const Selection& selection, const Quantity& quantity, bool guides);

}  // namespace polhode::study::report
