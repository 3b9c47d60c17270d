// SPDX-License-Identifier: BSD-3-Clause
// What makes one experiment differ from another: its question, and what it runs when nothing is said.
#pragma once

#include <map>
#include <string>

namespace polhode::study {

struct Experiment {
  std::string name;
  std::string question;  ///< one sentence
  /// The values of options that are not given, as the command line writes them: {"dt", "1e-3,1e-2"}.
  std::map<std::string, std::string> defaults;
  bool one_run = false;  ///< exactly one run, whose trajectory goes into the folder itself
};

}  // namespace polhode::study
