// SPDX-License-Identifier: BSD-3-Clause
// The command line of replay: that of every experiment, without what is about results, and some of its own.
#pragma once

#include <filesystem>

#include "experiments/study/plan/options.hpp"

namespace polhode::study::replay {

struct ReplayOptions {
  Options study;                  ///< what to run, where no results are named
  std::filesystem::path results;  ///< a study's folder; empty: carry the runs out
  std::vector<std::string> runs;  ///< ids; empty: all
  std::string scenario;           ///< as given; empty: it was not
  std::filesystem::path out;
  bool force = false;
  double limit_bytes = 0;
  std::filesystem::path three;     ///< folder of three.js
  std::optional<int> exit_status;  ///< where the command line said it all
};

const Experiment& replay_experiment();

/// Throws InputError.
ReplayOptions parse_replay_options(int argc, const char* const* argv);

}  // namespace polhode::study
