// SPDX-License-Identifier: BSD-3-Clause
// Command line of replay: the options of every experiment except those about results, and some of its own.
#pragma once

#include <filesystem>

#include "experiments/study/plan/options.hpp"

namespace polhode::study::replay {

struct ReplayOptions {
  Options study;                  ///< runs to carry out, if no results are given
  std::filesystem::path results;  ///< results folder of a study; empty: carry out the runs
  std::vector<std::string> runs;  ///< run ids; empty: all
  std::string scenario;           ///< scenario as given on the command line; empty: not given
  std::filesystem::path out;
  bool force = false;
  double limit_bytes = 0;
  std::filesystem::path three;     ///< folder of three.js
  std::optional<int> exit_status;  ///< set if the program must end at once (--help)
};

const Experiment& replay_experiment();

/// Parses the command line. Throws InputError.
ReplayOptions parse_replay_options(int argc, const char* const* argv);

}  // namespace polhode::study::replay
