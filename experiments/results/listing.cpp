// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "experiments/results/groups.hpp"
#include "experiments/results/output.hpp"
#include "experiments/study/query/named_options.hpp"
#include "experiments/study/query/pool.hpp"
#include "experiments/study/query/run_columns.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/in_order.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::results {
namespace {

using Of = RunColumn::Of;

constexpr std::size_t rows_of_terminal = 100;
constexpr std::size_t hits_of_a_part = 5000;  // a thread reads a part at a time

/// The configurations of the hits, each once.
std::vector<const Configuration*> configurations_of(const ResultStores& stores, const SelectedRuns& selection) {
  std::map<std::int64_t, const Configuration*> found;
  for (const Hit& hit : selection.hits) {
    const auto& known = stores.all()[hit.store]->configurations;
    if (const auto at = known.find(hit.configuration); at != known.end()) found.emplace(at->first, &at->second);
  }
  std::vector<const Configuration*> all;
  for (const auto& [key, configuration] : found) all.push_back(configuration);
  return all;
}

std::string value_in(const Configuration& configuration, const std::string& name) {
  const auto found = configuration.find(name);
  return found == configuration.end() ? "" : text_of(found->second);
}

RunColumn varied_key(const std::string& key) { return {.of = Of::scenario, .name = key, .key = key}; }

/// All columns that runs.csv has for these runs.
std::vector<RunColumn> all_columns(const ResultStores& stores, const RunColumns& columns,
                                   const SelectedRuns& selection) {
  std::vector<RunColumn> all = {{.of = Of::run, .name = "run"}};
  if (stores.folders().size() > 1) all.push_back({.of = Of::folder, .name = "folder"});
  const auto configurations = configurations_of(stores, selection);
  const auto some_have = [&](const std::string& name) {
    return std::any_of(configurations.begin(), configurations.end(),
                       [&](const Configuration* c) { return c->contains(name); });
  };
  const NamedOptions named = named_options(stores, configurations);
  for (const RunOption* option : options_by_column()) {
    if (!option->column.empty() && (!option->on_demand || named.contains(option->name)))
      all.push_back(columns.find(option->column, "--columns"));
  }
  for (const std::string& key : selection.varied_keys) all.push_back(varied_key(key));
  const RunKinds kinds{
      .reference = some_have("reference"), .contact = some_have("response"), .joints = some_have("stabilization")};
  for (const RunColumn& metric : columns.metrics(kinds)) all.push_back(metric);
  return all;
}

/// The columns for readers: what differs between the runs, and the metrics of the tables of runs.
std::vector<RunColumn> short_columns(const ResultStores& stores, const RunColumns& columns,
                                     const SelectedRuns& selection, bool with_scenario) {
  std::vector<RunColumn> all = {{.of = Of::run, .name = "run"}};
  if (stores.folders().size() > 1) all.push_back({.of = Of::folder, .name = "folder"});
  const auto configurations = configurations_of(stores, selection);
  for (const RunOption* option : options_by_column()) {
    if (option->column.empty()) continue;
    std::set<std::string> values;
    for (const Configuration* c : configurations) values.insert(value_in(*c, option->column));
    const bool always = option->role == RunOption::Role::method || option->role == RunOption::Role::size;
    const bool ambiguous = with_scenario && option->role == RunOption::Role::scenario;
    if (values.size() > 1 || ambiguous || (always && !values.contains("")))
      all.push_back(columns.find(option->column, "--columns"));
  }
  for (const std::string& key : selection.varied_keys) all.push_back(varied_key(key));
  for (const Metric* metric : in_table_order(metric_table())) {
    if (metric->in_summary && metric->column != "invariant_drifts_max_rel")
      all.push_back(columns.find(metric->column, "--columns"));
  }
  return all;
}

std::vector<RunColumn> chosen_columns(const ResultStores& stores, const RunColumns& columns,
                                      const ResultsOptions& options, const SelectedRuns& selection, Format format,
                                      bool with_scenario) {
  if (options.columns.empty() && format != Format::csv) return short_columns(stores, columns, selection, with_scenario);
  if (options.columns.empty() || options.columns == std::vector<std::string>{"all"})
    return all_columns(stores, columns, selection);
  std::vector<RunColumn> chosen;
  for (const std::string& name : options.columns) chosen.push_back(columns.find(name, "--columns"));
  return chosen;
}

std::vector<SortKey> sort_keys_of(const RunColumns& columns, const ResultsOptions& options) {
  std::vector<SortKey> keys;
  for (const std::string& said : options.sort) {
    const bool descending = said.starts_with('-');
    keys.push_back({columns.find(said.substr(descending ? 1 : 0), "--sort"), descending});
  }
  return keys;
}

/// The rows without columns in which no row has a value.
void write_without_empty_columns(Output& output, const std::vector<std::vector<OptionValue>>& rows,
                                 const std::vector<bool>& kept) {
  for (const auto& row : rows) {
    std::vector<OptionValue> cells;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (kept[k]) cells.push_back(row[k]);
    }
    output.add(cells);
  }
}

/// Makes the rows of a table of runs.
class RowMaker {
 public:
  RowMaker(const ScenarioNames& scenarios, const std::vector<RunColumn>& shown)
      : shown_(shown), cells_(scenarios), row_(shown.size()) {}

  /// Valid until the next call.
  const std::vector<OptionValue>& of(const CheckedRow& checked) {
    const std::pair configuration(checked.place.store, checked.place.configuration);
    const bool same = configuration == std::exchange(last_, configuration);
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      const RunColumn& column = shown_[k];
      if (same && column.of == Of::option) continue;
      row_[k] = cells_.value(column, checked.place, column.in_store() ? checked.values[column.index] : Value());
    }
    return row_;
  }

 private:
  const std::vector<RunColumn>& shown_;
  CellReader cells_;
  std::vector<OptionValue> row_;
  std::pair<const OpenStore*, std::int64_t> last_;  // neighbours mostly have the same options
};

/// Writes all rows as CSV, read and printed on all threads.
Damage write_all(const ResultStores& stores, const ScenarioNames& scenarios, const SelectedRuns& selection,
                 const std::vector<RunColumn>& shown, Output& output) {
  struct Worker {
    RunReader reader;
    RowMaker rows;
  };
  Pool<Worker> workers;  // kept from part to part, since they have opened stores
  Damage damage;
  const std::vector<std::size_t> parts = RunReader(stores).parts(selection, hits_of_a_part);
  in_order(parts.size() - 1, number_of_threads(0), [&](std::size_t k) -> UsePart {
    struct Part {
      std::string text;
      std::size_t rows = 0;
      Damage damage;
    };
    const auto part = std::make_shared<Part>();
    const auto worker = workers.take([&] {
      return std::make_unique<Worker>(
          Worker{RunReader(stores, RunReader::Connections::own), RowMaker(scenarios, shown)});
    });
    part->damage = worker->reader.read(selection, parts[k], parts[k + 1], [&](const CheckedRow& checked) {
      add_csv_row(part->text, worker->rows.of(checked));
      ++part->rows;
      return true;
    });
    return [&output, &damage, part] {
      output.add_csv_rows(part->text, part->rows);
      damage.add(part->damage);
    };
  });
  return damage;
}

}  // namespace

std::vector<Where> conditions_of(const ResultsOptions& options) {
  std::vector<Where> conditions;
  for (const std::string& text : options.where) conditions.emplace_back(text, "--where");
  return conditions;
}

int say_damage(const Damage& damage) {
  if (damage.runs == 0) return 0;
  fmt::print(stderr,
             "results: {} damaged and left out (the first: {}); the command of the study carries {} out again\n",
             damage.runs == 1 ? "1 run is" : fmt::format("{} runs are", damage.runs), damage.first,
             damage.runs == 1 ? "it" : "them");
  return damaged_runs;
}

int list_runs(const ResultStores& stores, const ResultsOptions& options) {
  const RunColumns columns(stores);
  const std::vector<Where> conditions = conditions_of(options);
  if (!options.group.empty()) return list_groups(stores, columns, conditions, options);
  const Format format = options.format.value_or(Format::table);
  const SelectedRuns selection = select(stores, columns, conditions, sort_keys_of(columns, options));
  const ScenarioNames scenarios(stores);
  const std::vector<RunColumn> shown =
      chosen_columns(stores, columns, options, selection, format, scenarios.ambiguous());
  std::size_t most = selection.hits.size();
  if (options.limit) most = *options.limit;
  else if (format == Format::table && options.out.empty()) most = rows_of_terminal;

  Damage damage;
  std::vector<std::string> names;
  for (const RunColumn& column : shown) names.push_back(column.name);
  if (format == Format::csv || !options.columns.empty()) {
    Output output(format, options.out, names);
    if (format == Format::csv && most == selection.hits.size()) {
      damage = write_all(stores, scenarios, selection, shown, output);
    } else {
      RowMaker rows(scenarios, shown);
      damage = RunReader(stores).read(selection, [&](const CheckedRow& checked) {
        if (output.rows() == most) return false;
        output.add(rows.of(checked));
        return true;
      });
    }
    output.finish();
    most = output.rows();
  } else {
    std::vector<std::vector<OptionValue>> rows;
    std::vector<bool> kept(shown.size());
    RowMaker maker(scenarios, shown);
    damage = RunReader(stores).read(selection, [&](const CheckedRow& checked) {
      if (rows.size() == most) return false;
      const std::vector<OptionValue>& row = maker.of(checked);
      for (std::size_t k = 0; k < row.size(); ++k) kept[k] = kept[k] || !text_of(row[k]).empty();
      rows.push_back(row);
      return true;
    });
    if (rows.empty()) kept.assign(kept.size(), true);
    std::vector<std::string> names_kept;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (kept[k]) names_kept.push_back(names[k]);
    }
    Output output(format, options.out, names_kept);
    write_without_empty_columns(output, rows, kept);
    output.finish();
    most = rows.size();
  }
  if (format == Format::table && options.out.empty()) {
    const std::size_t left_out = selection.runs - most - damage.runs;
    if (left_out > 0 && !options.limit) fmt::print("({} of {} runs; --limit shows more)\n", most, most + left_out);
    else fmt::print("{}\n", count(most, "run"));
  }
  return say_damage(damage);
}

}  // namespace polhode::study::results
