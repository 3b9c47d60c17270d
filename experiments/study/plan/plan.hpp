// SPDX-License-Identifier: BSD-3-Clause
// The plan of a study: the product of its axes, each run with its identity, before anything is run or written.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/study/plan/options.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline plan {

struct PlannedRun {
  std::string id;
  std::string motion;  ///< the same, whether errors are taken against a reference or not
  RunConfig config;
  std::shared_ptr<const Scenario> scenario;
  std::string refusal;  ///< why it makes no sense; empty if it does
  double cost = 0;      ///< a guess of its share of the work, in right-hand sides
};

struct Plan {
  std::vector<Scenario> scenarios;       ///< each one of the study once, without overrides
  std::vector<std::string> varied_keys;  ///< sorted
  NamedOptions named{};
  std::vector<std::string> invariants;  ///< further declared invariants of all scenarios, sorted
  std::vector<PlannedRun> runs;         ///< sorted by configuration, none twice
  /// Of the further products, where the experiment has some: their axes as the command line would write them.
  std::vector<std::map<std::string, std::string>> further_axes;
  std::string identity;  ///< hash over the ids of all runs
};

/// Throws InputError on anything that is wrong with the input, and when every run of the plan makes no sense.
Plan make_plan(const Experiment& experiment, const Options& options);

/// Adds those of the runs that the plan does not have yet; each belongs to a scenario of the plan with the varied
/// values of one of its runs. Returns how many there were. The plan's identity stays what it was.
std::size_t widen(Plan& plan, const std::vector<RunConfig>& configs);

}  // namespace polhode::study::plan
