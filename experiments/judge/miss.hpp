// SPDX-License-Identifier: BSD-3-Clause
// Miss of a hypothesis: distance of the rows of a trajectory from the motion that the hypothesis implies.
//
// Rows are compared with a motion in two ways: over spans of half a radian, each started from a row, so that errors
// which have grown since the start do not count; and over the first two radians, started from the scenario's start. The
// distance is an angle, √(attitude² + (ω / rate)²), and the miss its root mean square without the worst tenth.
#pragma once

#include <cstddef>
#include <vector>

#include "experiments/judge/hypothesis.hpp"
#include "experiments/judge/row_states.hpp"

namespace polhode::study::judge {

/// Miss over every `stride`-th span and, unless rows.first is empty, over the first rows, rad. The two parts are added
/// in quadrature.
double miss_of(const RowStates& rows, const Hypothesis& h, std::size_t stride = 1);

/// Miss of row 0 alone, from the scenario's start, rad.
double miss_of_start(const RowStates& rows, const Hypothesis& h);

/// States at rows.first of the motion from the scenario's start; fewer if the motion cannot be computed up to the last.
/// `motion` must be that of the hypothesis' problem and equations.
std::vector<VectorX<double>> motion_at_first_rows(const RowStates& rows, const Hypothesis& h,
                                                  const FaultyMotion& motion);

/// Root mean square without the worst tenth.
double typical(std::vector<double> misses);

}  // namespace polhode::study::judge
