// SPDX-License-Identifier: BSD-3-Clause
// One product of axes and tables of a study: makes the runs of its cells.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/study/plan/bound_conditions.hpp"
#include "experiments/study/plan/cells.hpp"
#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline plan {

class Product {
 public:
  /// Throws InputError for invalid axes.
  Product(const Experiment& experiment, const StudyAxes& study, const Options& options, bool reference);
  Product(const Product&) = delete;
  Product& operator=(const Product&) = delete;

  /// The number of cells, not less than the true one: values that are given twice count twice.
  double most_cells() const { return counted_; }

  /// A scenario of the product, without overrides.
  struct Opened {
    std::string name;  ///< as the study names it
    ScenarioSource source;
    std::shared_ptr<const Scenario> scenario;
    BoundConditions conditions;
  };
  /// The scenarios in their order. Valid after open().
  const std::vector<std::unique_ptr<Opened>>& opened() const { return opened_; }
  std::set<std::string> varied_keys() const;
  const StudyAxes& study() const { return study_; }

  struct Run {
    RunConfig config;
    std::shared_ptr<const Scenario> scenario;
  };
  /// What for_each() found.
  struct Count {
    std::size_t cells = 0, left_out = 0;
    std::vector<std::string> tables;  ///< in words
    std::set<std::string> effective;  ///< names of options of the study that affect a run
  };
  /// Calls use(cell, run) for each cell that the conditions do not leave out, in ascending order. Throws InputError for
  /// a value that a run cannot have, and if all cells are left out. `use` may throw std::invalid_argument for an
  /// impossible step, which becomes an InputError.
  Count for_each(const std::function<void(std::uint64_t cell, Run&& run)>& use);

  /// The run of a cell that for_each() gave. `scenario`: that of the run, if it is known. Thread-safe.
  Run run(std::uint64_t cell, std::shared_ptr<const Scenario> scenario) const;

 private:
  Cells make_cells(bool counted);
  void open_scenarios(const std::vector<Dimension>& dimensions);
  RunConfig start_of(const Opened& opened, const Scenario& scenario) const;
  RunConfig configured(const Cell& cell, const Opened& opened, const Scenario& scenario) const;
  Run made(const Cell& cell, const Opened& opened, std::shared_ptr<const Scenario> scenario) const;
  bool holds(const Cells::Place& place);
  void check(const RunConfig& config) const;

  Experiment experiment_;
  StudyAxes study_;
  std::optional<std::int64_t> max_steps_;
  bool reference_;
  std::vector<const RunOption*> needed_;
  std::vector<Where> conditions_;
  std::vector<std::unique_ptr<Opened>> opened_;
  std::map<std::string, Opened*> by_name_;  ///< by the name that the study says
  double counted_ = 0;
  std::optional<Cells> cells_;
};

}  // namespace polhode::study::plan
