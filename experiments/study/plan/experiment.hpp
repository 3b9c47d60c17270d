// SPDX-License-Identifier: BSD-3-Clause
// What makes one experiment differ from another: its question, and what it runs when nothing is said.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline plan {

/// A further product of axes: what it runs that differs from the first one's defaults. An option that the user gives
/// holds for all of them.
struct FurtherAxes {
  std::map<std::string, std::string> defaults{};
  std::vector<std::pair<std::string, std::string>> vary{};  ///< key of the scenario and its values
  bool reference = false;                                   ///< as --reference
  bool by_default_only = false;                             ///< left out where the user names an axis
};

struct Experiment {
  std::string name;
  std::string question;   ///< one sentence
  std::string meaning{};  ///< of its answer, for --help: one paragraph; empty: the question says it all
  /// The values of options that are not given, as the command line writes them: {"dt", "1e-3,1e-2"}.
  std::map<std::string, std::string> defaults;
  /// An ensemble of starts, as --vary writes it; taken where neither a scenario, a study file nor that key is given.
  std::vector<std::pair<std::string, std::string>> vary{};
  bool reference = false;  ///< as if --reference were given
  std::vector<FurtherAxes> more{};
  bool one_run = false;               ///< exactly one run, whose trajectory goes into the folder itself
  bool best_times = false;            ///< short runs are carried out several times, and the least wall time is kept
  bool fixed_steps_only = false;      ///< methods that choose their own steps have no place in it
  bool failures_are_results = false;  ///< a run that a method could not carry on is an answer, not a fault
  /// s, how long a run lasts: of the duration that was asked for and its step. Empty: what was asked for.
  std::function<double(double t_end, double dt)> duration{};
  /// Given all finished runs, which further ones it wants. It is asked again with those, until it wants nothing new.
  /// The same runs must always lead to the same wishes: then a study that is stopped finds again what it has.
  std::function<std::vector<RunConfig>(const StudyView&)> refine{};
  /// What it makes of its finished runs beyond what every study shows; empty: nothing.
  std::function<Analysis(const StudyView&)> analysis{};
};

}  // namespace polhode::study
