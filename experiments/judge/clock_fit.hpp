// SPDX-License-Identifier: BSD-3-Clause
// Fit of a wrong clock to the rows of a trajectory: the shift, or the rate, of t_s that fits best.
#pragma once

#include <optional>

#include "experiments/judge/miss.hpp"

namespace polhode::study::judge {

/// Adds the shift that fits best to a hypothesis: the row at t_s shows the motion at another time. Absent if fewer than
/// three of the first rows are compared, or if the motion cannot be computed up to the last of them.
std::optional<Hypothesis> fitted_shift(const RowStates& rows, const Hypothesis& base);

/// Adds the rate that fits best to a hypothesis: the motion runs faster or slower than t_s.
///
/// The rate is excused if the truncation error of a second-order method explains it: with a rotation of x rad per step,
/// its motion is slow or fast by x²/12 to x²/4 (for dmv this is its whole error except that of the attitude). The steps
/// are assumed to be as long as the spacing of the rows. A rate in this range is not excused if the fit is far better
/// than that of such a method and the axis of rotation moves.
Hypothesis fitted_rate(const RowStates& rows, const Hypothesis& base);

}  // namespace polhode::study::judge
