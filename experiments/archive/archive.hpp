// SPDX-License-Identifier: BSD-3-Clause
// Visits a folder of results, and prints or saves what there is of its trajectories.
#pragma once

#include <filesystem>
#include <string>

namespace polhode::study::archive {

constexpr int not_whole = 1;  ///< exit status

struct Inventory {
  std::string text;      ///< a line for each trajectory, then their number
  bool all_well = true;  ///< check: all are whole; repair: all that are not were saved as far as they go
};

/// Reads every number of every trajectory below the folder. Changes no file.
Inventory check(const std::filesystem::path& folder);

/// The same, and recover() for each that is not whole. Whole ones are not touched, and nothing is removed. Throws
/// TrajectoryError if what is saved cannot be written.
Inventory repair(const std::filesystem::path& folder);

}  // namespace polhode::study::archive
