// SPDX-License-Identifier: BSD-3-Clause
// Reads the reactions of joints that were written beside a trajectory.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::study::inline trajectory {

/// Forces (N, world axes) of the joints on their first bodies from reactions.csv in a folder: those of all joints at
/// the first instant, then at the next. None unless the file is there with a row for each joint at each of the times
/// (s). Throws InputError for a file that cannot be read.
std::vector<Vector3<double>> read_reactions(const std::filesystem::path& folder, std::span<const double> times,
                                            std::size_t joints);

}  // namespace polhode::study::trajectory
