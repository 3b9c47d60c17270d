// SPDX-License-Identifier: BSD-3-Clause
// Reads the motion that a study has kept as CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/replay/recording.hpp"

namespace polhode::study::replay {

struct KeptStudy {
  Scenario scenario;                  ///< without the varied keys
  std::string command;                ///< that made it
  std::string made_by;                ///< "polhode 0.1.0, commit 1234abc"
  std::vector<Recording> recordings;  ///< in the order of runs.csv
};

/// Of the runs with a trajectory, all or those of the ids. `scenario` (a name or a file) stands for the one that the
/// study names, where it is not empty. Throws InputError.
KeptStudy read_study(const std::filesystem::path& folder, const std::vector<std::string>& ids,
                     const std::string& scenario, std::size_t most_runs);

}  // namespace polhode::study
