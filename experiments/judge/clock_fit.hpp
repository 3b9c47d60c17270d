// SPDX-License-Identifier: BSD-3-Clause
// A wrong clock that explains the rows: the shift, or the rate, of t_s that fits best.
#pragma once

#include <optional>

#include "experiments/judge/miss.hpp"

namespace polhode::study::judge {

/// Adds the shift that fits best to a hypothesis: the row at t_s shows the motion of another time. Empty where fewer
/// than three of the first rows are compared or the motion cannot be followed to the last of them.
std::optional<Hypothesis> fitted_shift(const RowStates& rows, const Hypothesis& base);

/// Adds the rate that fits best to a hypothesis: the motion runs faster or slower than t_s.
///
/// A method of second order that turns by x rad in a step is slow or fast by x²/12 to x²/4, dmv exactly so but for the
/// attitude. A rate that steps as large as the rows are apart excuse is no sign of a wrong clock, unless the fit is far
/// better than the fit of such a method and the axis moves.
Hypothesis fitted_rate(const RowStates& rows, const Hypothesis& base);

}  // namespace polhode::study
