// SPDX-License-Identifier: BSD-3-Clause
// Panels of a quantity against the step, or against the tolerance of adaptive methods. Both axes are logarithmic.
#pragma once

#include <vector>

#include "experiments/study/curves/selection.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline report::inline figures {

bool has_several_steps(const Curve& curve);
bool has_value(const Curve& curve, const Quantity& quantity);
/// True if some run of the curve has a value, or ended early and is marked by a cross.
bool has_mark(const Curve& curve, const Quantity& quantity);

/// Panels with a common y axis; panels in which all values are exactly zero are left out. `guides`: draw gray lines of
/// slope 1, 2 and 4.
std::vector<Panel> panels_against_step(const Selection& selection, const Quantity& quantity, bool guides);

}  // namespace polhode::study::report::figures
