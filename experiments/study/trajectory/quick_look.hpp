// SPDX-License-Identifier: BSD-3-Clause
// Whether a trajectory that is kept seems whole, at a glance: a study looks at thousands of them when it starts.
#pragma once

#include <filesystem>

#include "experiments/study/trajectory/trajectory_files.hpp"

namespace polhode::study::inline trajectory {

/// True if all files stand in the folder, as has_trajectory() says, and none of them is cut: the last line of each CSV
/// file has an end, and trajectory.csv and energy.csv end with the same instant; the HDF5 file can be opened. What lies
/// before the end is not read: kept_trajectory() does that.
bool seems_whole(TrajectoryFormat format, const std::filesystem::path& folder);

}  // namespace polhode::study::trajectory
