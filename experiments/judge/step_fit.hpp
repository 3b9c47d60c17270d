// SPDX-License-Identifier: BSD-3-Clause
// First-order steps that explain the rows: for each method the whole number of steps from row to row that fits best,
// and the best of the methods.
#pragma once

#include <optional>

#include "experiments/judge/miss.hpp"

namespace polhode::study::judge {

/// Adds the steps of FirstOrderStep that fit best to a hypothesis.
Hypothesis fitted_steps(const RowStates& rows, const Hypothesis& base);

/// Adds the steps that fit best where no step brings the rotation matrix back to a rotation, by the catalogue's
/// methods. Empty without matrices and angular velocities in the file. `plain` has nothing wrong.
std::optional<Hypothesis> fitted_steps_without_projection(const RowStates& rows, const Hypothesis& plain);

}  // namespace polhode::study
