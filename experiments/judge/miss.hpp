// SPDX-License-Identifier: BSD-3-Clause
// How far the rows of a trajectory are from the motion that a hypothesis implies.
//
// Rows are set against a motion in two ways: over spans of half a radian, each started from a row, so that errors which
// have grown since the start do not count; and over the first two radians, started as the scenario says. A miss is an
// angle: √(attitude² + (ω / rate)²), root mean square without the worst tenth.
#pragma once

#include <cstddef>
#include <vector>

#include "experiments/judge/hypothesis.hpp"
#include "experiments/judge/row_states.hpp"

namespace polhode::study::judge {

/// rad, from every `stride`-th span and, unless rows.first is empty, from the first rows.
double miss_of(const RowStates& rows, const Hypothesis& h, std::size_t stride = 1);

/// rad, from row 0 alone and the scenario's start.
double miss_of_start(const RowStates& rows, const Hypothesis& h);

/// The states at rows.first of the motion from the scenario's start; fewer where it cannot be followed to the last.
/// `motion` is that of the hypothesis' problem and equations.
std::vector<VectorX<double>> motion_at_first_rows(const RowStates& rows, const Hypothesis& h,
                                                  const FaultyMotion& motion);

/// The root mean square without the worst tenth.
double typical(std::vector<double> misses);

}  // namespace polhode::study
