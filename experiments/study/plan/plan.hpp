// SPDX-License-Identifier: BSD-3-Clause
// Plan of a study: all runs of its cells, with their identities, made before anything is run or written.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/study/plan/options.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline plan {

struct PlannedRun {
  std::string id;      ///< as RunRecord::id
  std::string motion;  ///< hash of the same text without --reference: equal for runs of the same motion
  RunConfig config;
  std::shared_ptr<const Scenario> scenario;
  std::string refusal;       ///< reason for which the run cannot be carried out; empty if it can
  double cost = 0;           ///< estimated work, in evaluations of the right-hand side
  bool keeps_curves = true;  ///< its curves against time are kept (--curves)
};

/// How one study became runs.
struct StudyCount {
  std::string name;                 ///< empty: the only one
  std::size_t cells = 0;            ///< of the product of its axes and tables
  std::size_t left_out = 0;         ///< cells that its conditions leave out
  std::vector<std::string> tables;  ///< its tables of points in words: "zip of dt, t-end: 2 points: (0.001, 10), …"
};

struct Plan {
  std::vector<Scenario> scenarios;          ///< each scenario of the study once, without overrides
  std::vector<std::string> scenario_names;  ///< as the study names them: "peters_hsu", "tops/heavy.toml"
  std::vector<std::string> varied_keys;     ///< scenario keys that are axes, sorted
  NamedOptions named{};                     ///< options on demand that the study gives
  std::vector<std::string> invariants;      ///< further declared invariants of all scenarios, sorted
  std::vector<PlannedRun> runs;             ///< sorted by configuration, without duplicates
  std::vector<StudyCount> studies;
  /// Axes of each further product of the experiment (Experiment::more), in the syntax of the command line.
  std::vector<std::map<std::string, std::string>> further_axes;
  std::string identity;  ///< hash of the ids of all runs
};

/// Makes the plan. Throws InputError for invalid input, and if no run of the plan can be carried out.
Plan make_plan(const Experiment& experiment, const Options& options);

/// Adds runs that the plan does not contain yet; leaves the plan's identity unchanged. Each must have the scenario and
/// the varied values of a run of the plan. Returns the number of runs added. Throws std::logic_error for a run of
/// another scenario.
std::size_t widen(Plan& plan, const std::vector<RunConfig>& configs);

}  // namespace polhode::study::plan
