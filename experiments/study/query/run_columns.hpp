// SPDX-License-Identifier: BSD-3-Clause
// The columns of stored runs by name: id and folder, options, keys of the scenario, metrics, wall time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/scenario_names.hpp"
#include "experiments/study/store/value.hpp"

namespace polhode::study::inline query {

struct RunColumn {
  enum class Of {
    run,        ///< the id
    folder,     ///< the folder of the study
    option,     ///< an option of the run
    scenario,   ///< a key of the scenario: its varied value, else that of the scenario
    metric,     ///< a column of the store, wall_s among them
    invariant,  ///< one of the numbers in invariant_drifts_max_rel
  };
  Of of = Of::run;
  std::string name;       ///< name in headings: "dt_s"
  std::string key{};      ///< key of the option, the scenario or the invariant
  std::size_t index = 0;  ///< index in RunRows::columns(), for metrics and invariants
  bool in_store() const { return of == Of::metric || of == Of::invariant; }
};

class RunColumns {
 public:
  explicit RunColumns(const ResultStores& stores);  ///< `stores` must outlive this object

  /// The column with this name. Options are named as in runs.csv or as in study files: dt_s, dt. `evaluations` is
  /// rhs_evaluations, `seconds` is wall_s. Throws InputError, which begins with the label and suggests names.
  RunColumn find(const std::string& name, const std::string& label) const;

  std::vector<std::string> names()
      const;  ///< names of all columns that find() takes, sorted; varied keys stand for the scenario's
  std::vector<RunColumn> options() const;  ///< options with a value in some run, in the order of runs.csv
  /// All metrics in the order of runs.csv, without those that are defined for no run.
  std::vector<RunColumn> metrics(const RunKinds& kinds) const;
  std::size_t index(std::string_view column) const;  ///< index in RunRows::columns(). Throws std::logic_error

 private:
  bool is_scenario_key(const std::string& name) const;

  const ResultStores* stores_;
  std::vector<std::string> stored_;  ///< RunRows::columns()
  std::set<std::string> options_, invariants_;
};

/// A run, and where it stands.
struct RunPlace {
  const OpenStore* store;
  std::int64_t id;
  std::int64_t configuration;  ///< key
  std::string_view varied;     ///< runs.varied
};

/// Makes cells; keeps what it has read of scenarios.
class CellReader {
 public:
  CellReader() = default;
  /// Cells have these names of scenarios. `names` must outlive this object.
  explicit CellReader(const ScenarioNames& names) : names_(names.ambiguous() ? &names : nullptr) {}

  /// The value of a run in a column; std::monostate: it has none. `stored`: the value in the column of the store, of
  /// metrics and invariants.
  OptionValue value(const RunColumn& column, const RunPlace& run, const Value& stored);

 private:
  /// A key in a scenario without varied keys; the path is empty if the scenario does not have it.
  struct Known {
    std::string path;
    OptionValue value;
  };
  const Configuration* configuration_of(const RunPlace& run);  ///< null: it is damaged
  const Known& known(const std::string& key, const OpenStore& store, const std::string& scenario);
  OptionValue of_scenario(const std::string& key, const RunPlace& run, const std::string& scenario);

  const ScenarioNames* names_ = nullptr;
  const OpenStore* last_store_ = nullptr;  ///< neighbouring rows mostly have the same configuration
  std::int64_t last_key_ = 0;
  const Configuration* last_ = nullptr;
  std::map<std::tuple<const OpenStore*, std::string, std::string>, Known> known_;  ///< keys by store, scenario and key
};

/// Names of the invariants that the scenarios of the store declare. Scenarios that cannot be read are left out.
std::set<std::string> invariants_of(const OpenStore& store);

}  // namespace polhode::study::query
