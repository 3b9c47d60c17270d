// SPDX-License-Identifier: BSD-3-Clause
// Fit of a first-order method to the rows of a trajectory: for each method the number of steps from row to row that
// fits best, and the best of the methods.
#pragma once

#include <optional>

#include "experiments/judge/miss.hpp"

namespace polhode::study::judge {

/// Adds the steps of FirstOrderStep that fit best to a hypothesis.
Hypothesis fitted_steps(const RowStates& rows, const Hypothesis& base);

/// Adds to a hypothesis the steps that fit best, for methods of the catalogue that do not project the rotation matrix
/// to a rotation. Absent if the file has no matrices or no angular velocities. plain: the hypothesis without a fault.
std::optional<Hypothesis> fitted_steps_without_projection(const RowStates& rows, const Hypothesis& plain);

}  // namespace polhode::study::judge
