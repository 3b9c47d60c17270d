// SPDX-License-Identifier: BSD-3-Clause
// Plan of a study: all runs of its cells, with their identities, made before anything is run or written. Of each run
// one row of 32 bytes is held; the run is made from its cell when it is requested.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/study/plan/last_options.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline plan {

class Product;

struct PlannedRun {
  std::string id;  ///< id, the same as RunRecord::id
  RunConfig config;
  std::shared_ptr<const Scenario> scenario;
  std::string refusal;       ///< reason for which the run cannot be carried out; empty if it can
  double cost = 0;           ///< estimated work, the same as PlanRow::cost
  bool keeps_curves = true;  ///< curves against time are kept, the same as PlanRow::keeps_curves
};

/// The data that a plan holds for each run.
struct PlanRow {
  std::uint64_t id = 0;        ///< id as a number: number_of_id()
  std::uint64_t scenario = 0;  ///< number_of() its scenario, with the varied keys set
  float cost = 0;              ///< estimated work, in evaluations of the right-hand side
  std::uint32_t cell = 0;      ///< number of its cell in its product, or of its run among the further ones
  std::uint16_t product = 0;   ///< index of its product; that after the last one: the further runs
  std::uint16_t kind = 0;      ///< index in Plan::kinds
  bool refused = false;        ///< it cannot be carried out
  bool own_presets = false;    ///< the same as Product::Run::own_presets
  bool keeps_curves = true;    ///< its curves against time are kept (--curves)
};

/// The counts by which one study became runs.
struct StudyCount {
  std::string name;                 ///< name of the study; empty: the only one
  std::size_t cells = 0;            ///< number of cells of the product of its axes and tables
  std::size_t left_out = 0;         ///< cells that its conditions leave out
  std::vector<std::string> tables;  ///< its tables of points in words: "zip of dt, t-end: 2 points: (0.001, 10), …"
};

/// What runs that are made one after another share: scenarios with their varied keys set, by PlanRow::scenario, and the
/// options of the last run.
class Variants {
 public:
  /// `most`: the largest number that is held.
  explicit Variants(std::size_t most = 256) : most_(most) {}

  LastOptions last;

  std::shared_ptr<const Scenario> find(std::uint64_t scenario) const {
    const auto found = held_.find(scenario);
    return found == held_.end() ? nullptr : found->second;
  }
  void add(std::uint64_t scenario, const std::shared_ptr<const Scenario>& variant) {
    if (held_.size() == most_) held_.clear();
    held_.emplace(scenario, variant);
  }

 private:
  std::size_t most_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const Scenario>> held_;
};

class Plan {
 public:
  std::vector<Scenario> scenarios;          ///< each scenario of the study once, without overrides
  std::vector<std::string> scenario_names;  ///< scenarios as written in the study: "peters_hsu", "tops/heavy.toml"
  std::vector<std::string> varied_keys;     ///< scenario keys that are axes, sorted
  NamedOptions named{};                     ///< options on demand that the study gives
  std::vector<std::string> invariants;      ///< further declared invariants of all scenarios, sorted
  std::vector<PlanRow> rows;                ///< the runs, sorted by configuration, without duplicates
  std::vector<std::string> kinds;           ///< runs of a kind take times in proportion to their cost
  /// The different values of each column of the configuration, by name: their number, and the first runs that have
  /// them, at most 24.
  struct Values {
    std::size_t count = 0;
    std::vector<std::uint32_t> runs;
  };
  std::map<std::string, Values> values;
  std::vector<StudyCount> studies;
  double runs_of_a_row = 1;  ///< runs for each row; above 1 if the rows are a choice of the runs (glance_at_plan)
  /// Axes of each further product of the experiment (Experiment::more), in the syntax of the command line.
  std::vector<std::map<std::string, std::string>> further_axes;
  std::string identity;  ///< hash of the ids of all runs

  std::size_t size() const { return rows.size(); }
  /// Number of different motions of the scenarios (Product::most_true_motions) without those of widen().
  double most_true_motions() const;
  /// Run i, below size(). Takes what it shares with other runs from `known`, and puts it there, unless `known` is null
  /// or the run has own_presets. Thread-safe for different `known`.
  PlannedRun run(std::size_t i, Variants* known = nullptr) const;
  /// The configuration of run i. The scenario is made only for a run with own_presets.
  /// `last`: the options of the run before, which become those of this one. Thread-safe for different `last`.
  RunConfig config(std::size_t i, LastOptions* last = nullptr) const;
  /// All runs, for a plan of a few.
  std::vector<PlannedRun> runs() const;
  /// Number of the run with this id.
  std::optional<std::size_t> find(std::uint64_t id) const;
  bool contains(std::uint64_t id) const { return find(id).has_value(); }

 private:
  friend Plan make_plan(const Experiment& experiment, const Options& options);
  friend std::optional<Plan> glance_at_plan(const Experiment& experiment, const Options& options);
  friend std::size_t widen(Plan& plan, const std::vector<RunConfig>& configs);
  struct Further {
    RunConfig config;
    std::shared_ptr<const Scenario> scenario;
  };
  std::vector<std::shared_ptr<const Product>> products_;
  std::vector<Further> further_;
  std::vector<std::uint32_t> by_id_;  // numbers of the rows, sorted by id
};

/// Makes the plan. Throws InputError for invalid input, and if no run of the plan can be carried out.
Plan make_plan(const Experiment& experiment, const Options& options);

/// A plan with some 10 000 runs of a study of more than 100 000 cells, evenly chosen, for what --dry-run says before it
/// has planned all of them; with fewer runs, in proportion, if scenarios have more than four bodies in the mean. Absent
/// if the study has no more cells, or its conditions leave out all that were chosen.
std::optional<Plan> glance_at_plan(const Experiment& experiment, const Options& options);

/// Adds runs that the plan does not contain yet; leaves the plan's identity unchanged. Each must have the scenario and
/// the varied values of a run of the plan. Returns the number of runs added. Throws std::logic_error for a run of
/// another scenario.
std::size_t widen(Plan& plan, const std::vector<RunConfig>& configs);

}  // namespace polhode::study::plan
