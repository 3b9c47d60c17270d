// SPDX-License-Identifier: BSD-3-Clause
// What makes one experiment differ from another: its question, and what it runs when nothing is said.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/study_view.hpp"

namespace polhode::study {

/// A further product of axes: what it runs that differs from the first one's defaults. An option that the user gives
/// holds for all of them.
struct FurtherAxes {
  std::map<std::string, std::string> defaults{};
  bool reference = false;  ///< as --reference
};

struct Experiment {
  std::string name;
  std::string question;  ///< one sentence
  /// The values of options that are not given, as the command line writes them: {"dt", "1e-3,1e-2"}.
  std::map<std::string, std::string> defaults;
  /// An ensemble of starts, as --vary writes it; taken where neither a scenario, a study file nor that key is given.
  std::vector<std::pair<std::string, std::string>> vary{};
  bool reference = false;  ///< as if --reference were given
  std::vector<FurtherAxes> more{};
  bool one_run = false;  ///< exactly one run, whose trajectory goes into the folder itself
  bool best_times = false;  ///< short runs are carried out several times, and the least wall time is kept
  /// What it makes of its finished runs beyond what every study shows; empty: nothing.
  std::function<Analysis(const StudyView&)> analysis{};
};

}  // namespace polhode::study
