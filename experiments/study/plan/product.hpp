// SPDX-License-Identifier: BSD-3-Clause
// One product of axes and tables of a study: makes the runs of its cells.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/plan/bound_conditions.hpp"
#include "experiments/study/plan/cells.hpp"
#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/last_options.hpp"
#include "experiments/study/plan/study_axes.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline plan {

class Product {
 public:
  /// `reference`: as --reference, for motions without contact alone. With contact no reference can be made, and a run
  /// for which it is asked is refused. Throws InputError for invalid axes.
  Product(const Experiment& experiment, const StudyAxes& study, bool reference);
  Product(const Product&) = delete;
  Product& operator=(const Product&) = delete;

  /// The number of cells, not less than the true one: values that are given twice count twice.
  double most_cells() const { return counted_; }
  /// The number of different motions of the scenarios, not less than the true one: cells that differ in a scenario, a
  /// key of it or the duration.
  double most_true_motions() const { return true_motions_; }

  /// A scenario of the product, without overrides.
  struct Opened {
    std::string name;  ///< name as it is written in the study
    ScenarioSource source;
    std::shared_ptr<const Scenario> scenario;
    BoundConditions conditions;
  };
  /// The scenarios in their order.
  const std::vector<std::unique_ptr<Opened>>& opened() const { return opened_; }
  std::set<std::string> varied_keys() const;
  const StudyAxes& study() const { return study_; }

  struct Run {
    RunConfig config;
    std::shared_ptr<const Scenario> scenario;
    bool own_presets =
        false;  ///< set by for_each(): the varied keys change the default of an option, t_end that of --t-end
    /// Set by for_each(): the configuration differs from that of the run before in the varied keys alone.
    bool same_options = false;
  };
  /// Makes the cells, each of which can then be made from its number. Throws InputError for invalid values.
  void open();
  std::uint64_t cells() const;              ///< their number; valid after open(), as are all members below
  std::vector<std::string> tables() const;  ///< the tables of points, in words

  /// The findings in a part of the cells.
  struct Part {
    std::size_t left_out = 0;         ///< number of cells that the conditions leave out
    std::set<std::string> effective;  ///< names of options of the study that affect a run
  };
  /// Calls use(cell, run) for each of these cells that the conditions do not leave out, in their order. Throws
  /// InputError for a value that a run cannot have. `use` may throw std::invalid_argument for an impossible step, which
  /// becomes an InputError. Thread-safe.
  Part for_each(std::span<const std::uint64_t> cells,
                const std::function<void(std::uint64_t cell, Run&& run)>& use) const;

  /// Throws InputError, which says that the conditions leave out all cells.
  [[noreturn]] void refuse_empty() const;

  /// The run of a cell that for_each() gave. `scenario`: that of the run, if it is known. `last`: the options of the
  /// run before, which become those of this one; null for a run with own_presets. Thread-safe for different `last`.
  Run run(std::uint64_t cell, std::shared_ptr<const Scenario> scenario, LastOptions* last) const;
  /// The configuration of such a run, which must have no own_presets. Its scenario is not made. Thread-safe as run()
  /// is.
  RunConfig config(std::uint64_t cell, LastOptions* last) const;

 private:
  Cells make_cells(bool counted);
  void open_scenarios(const std::vector<Dimension>& dimensions);
  const Opened& opened_of(const Cell& cell) const { return *by_name_.find(cell.scenario)->second; }
  RunConfig start_of(const Opened& opened, const Scenario& scenario) const;
  RunConfig configured(const Cell& cell, const Opened& opened, const Scenario& scenario) const;
  RunConfig completed(const Cell& cell, const Opened& opened, const Scenario& scenario) const;
  RunConfig completed(const Cell& cell, const Opened& opened, const Scenario& scenario, LastOptions* last) const;
  bool has_own_presets(const RunConfig& config, const Opened& opened, const Scenario& scenario) const;
  static std::shared_ptr<const Scenario> scenario_of(const Cell& cell, const Opened& opened);
  /// Conditions of each scenario, with what they keep from cell to cell.
  using Conditions = std::map<const Opened*, BoundConditions>;
  bool holds(const Cells::Place& place, Conditions& conditions) const;
  void check(const RunConfig& config) const;

  Experiment experiment_;
  StudyAxes study_;
  bool reference_;
  std::vector<const RunOption*> needed_;
  std::vector<const RunOption*> with_presets_;
  std::vector<Where> conditions_;
  std::vector<std::unique_ptr<Opened>> opened_;
  std::map<std::string, Opened*, std::less<>> by_name_;  ///< scenarios by the name that is written in the study
  double counted_ = 0, true_motions_ = 1;
  std::optional<Cells> cells_;
};

}  // namespace polhode::study::plan
