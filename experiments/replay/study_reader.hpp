// SPDX-License-Identifier: BSD-3-Clause
// Reads the motions that a study has stored as CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/replay/recording.hpp"

namespace polhode::study::replay {

struct KeptStudy {
  Scenario scenario;                  ///< scenario of the study, without the varied keys
  std::string command;                ///< command line of the study
  std::string made_by;                ///< version of the program: "polhode 0.1.0, commit 1234abc"
  std::vector<Recording> recordings;  ///< recordings in the order of runs.csv
};

/// Reads the runs that have a trajectory, with these ids (empty: all). scenario: name or file that replaces the
/// scenario named in the study; empty: none. Throws InputError, also for more than most_runs runs.
KeptStudy read_study(const std::filesystem::path& folder, const std::vector<std::string>& ids,
                     const std::string& scenario, std::size_t most_runs);

}  // namespace polhode::study::replay
