// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/run_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "experiments/study/query/stored_run.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario_override.hpp"
#include "experiments/study/store/run_rows.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline query {
namespace {

using Of = RunColumn::Of;

constexpr std::string_view drift_of_invariant = "_drift_max_rel";
constexpr std::string_view invariant_column = "invariant_drifts_max_rel";

/// Name of the option in a Configuration.
std::string stored_name(const RunOption& option) { return option.column.empty() ? file_key(option) : option.column; }

/// "rhs_evaluations" for "evaluations" and so on; else the name.
std::string full_name(const std::string& name) {
  if (name == "evaluations") return "rhs_evaluations";
  if (name == "seconds") return "wall_s";
  if (name == "id") return "run";
  for (const RunOption& option : run_options()) {
    if (name == file_key(option) || name == option.name) return stored_name(option);
  }
  return name;
}

OptionValue value_of_store(const Value& value) {
  return std::visit(
      []<class T>(const T& v) -> OptionValue {
        if constexpr (std::is_same_v<T, std::string_view>) return std::string(v);
        else if constexpr (std::is_same_v<T, Blob>) return {};
        else return v;
      },
      value);
}

/// A TOML value as one cell: a number, a text without its quotes, else as it is written.
OptionValue cell_of_toml(const std::string& text) {
  if (const auto x = to_number(text)) return *x;
  const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::string in_toml(const TomlValue& value) {
  switch (value.type) {
    case TomlValue::Type::number: return exact(value.number);
    case TomlValue::Type::boolean: return value.boolean ? "true" : "false";
    case TomlValue::Type::list: {
      std::string items;
      for (const TomlValue& item : value.items) items += (items.empty() ? "" : ",") + in_toml(item);
      return "[" + items + "]";
    }
    default: return value.text;
  }
}

/// True if the key of the second path is within the value of the first: body.0.inertia and body.0.inertia.1.
bool is_above(const std::string& path, const std::string& other) {
  return !path.empty() && other.starts_with(path + ".");
}

/// The number of an invariant in "name=number …".
OptionValue number_of(const std::string& invariant, const Value& stored) {
  const auto* text = std::get_if<std::string_view>(&stored);
  for (std::size_t at = 0; text && at < text->size();) {
    const std::size_t end = std::min(text->find(' ', at), text->size());
    const std::string_view item = text->substr(at, end - at);
    const std::size_t equals = item.find('=');
    if (item.substr(0, equals) == invariant && equals != std::string_view::npos) {
      if (const auto x = to_number(item.substr(equals + 1))) return *x;
    }
    at = end + 1;
  }
  return {};
}

}  // namespace

std::set<std::string> invariants_of(const OpenStore& store) {
  std::set<std::string> names;
  for (const auto& [name, scenario] : store.scenarios) {
    try {
      const auto& declared = source_of(store.scenarios, name).resolve().invariants;
      names.insert(declared.begin(), declared.end());
    } catch (const std::runtime_error&) {
    }
  }
  return names;
}

RunColumns::RunColumns(const ResultStores& stores) : stores_(&stores) {
  for (const ResultTable& table : {runs_table(metric_table()), timings_table()}) {
    for (const ResultColumn& column : table.columns) stored_.push_back(column.name);
  }
  for (const auto& open : stores.all()) {
    for (const auto& [key, configuration] : open->configurations) {
      for (const auto& [name, value] : configuration) options_.insert(name);
    }
    invariants_.merge(invariants_of(*open));
  }
}

std::size_t RunColumns::index(std::string_view column) const {
  const auto found = std::find(stored_.begin(), stored_.end(), column);
  if (found == stored_.end()) throw std::logic_error("the store has no column " + std::string(column));
  return static_cast<std::size_t>(found - stored_.begin());
}

bool RunColumns::is_scenario_key(const std::string& name) const {
  for (const auto& open : stores_->all()) {
    for (const auto& [scenario, text] : open->scenarios) {
      try {
        source_of(open->scenarios, scenario).find({name, "", ""});
        return true;
      } catch (const std::runtime_error&) {
      }
    }
  }
  return false;
}

RunColumn RunColumns::find(const std::string& name, const std::string& label) const {
  const std::string full = full_name(name);
  if (full == "run") return {.of = Of::run, .name = full};
  if (full == "folder") return {.of = Of::folder, .name = full};
  const bool option = std::any_of(run_options().begin(), run_options().end(),
                                  [&](const RunOption& o) { return stored_name(o) == full; });
  if (option || options_.contains(full)) return {.of = Of::option, .name = full, .key = full};
  const bool own = full == configuration_column || full == varied_column || full == has_curves;
  if (!own && std::find(stored_.begin(), stored_.end(), full) != stored_.end())
    return {.of = Of::metric, .name = full, .index = index(full)};
  if (full.ends_with(drift_of_invariant)) {
    const std::string invariant = full.substr(0, full.size() - drift_of_invariant.size());
    if (invariants_.contains(invariant))
      return {.of = Of::invariant, .name = full, .key = invariant, .index = index(invariant_column)};
  }
  if (is_scenario_key(full)) return {.of = Of::scenario, .name = full, .key = full};
  const std::vector<std::string> all = names();
  throw InputError(label + ": there is no column '" + name + "'" +
                   suggestion_of_many(name, {all.begin(), all.end()}, "--list"));
}

std::vector<std::string> RunColumns::names() const {
  std::set<std::string> all = {"run", "folder", "wall_s", "t_reached_s"};
  for (const RunOption& option : run_options()) {
    all.insert(stored_name(option));
    all.insert(file_key(option));
  }
  for (const RunColumn& metric : metrics({.reference = true, .contact = true, .joints = true})) all.insert(metric.name);
  for (const auto& open : stores_->all()) {
    const std::size_t chosen[] = {index(varied_column)};
    RunRows(open->store).scan(chosen, [&](const RunRows::Part& part) {
      const auto* text = std::get_if<std::string_view>(&part.values[0]);
      if (!text) return;
      for (std::size_t at = 0; at < text->size();) {
        const std::size_t end = std::min(text->find('\n', at), text->size());
        all.emplace(text->substr(at, text->substr(at, end - at).find('=')));
        at = end + 1;
      }
    });
  }
  return {all.begin(), all.end()};
}

std::vector<RunColumn> RunColumns::options() const {
  std::vector<RunColumn> columns;
  for (const RunOption* option : options_by_column()) {
    if (option->column.empty() || !options_.contains(option->column)) continue;
    columns.push_back({.of = Of::option, .name = option->column, .key = option->column});
  }
  return columns;
}

std::vector<RunColumn> RunColumns::metrics(const RunKinds& kinds) const {
  std::vector<RunColumn> columns;
  for (const Metric& metric : metric_table()) {
    if (!kinds.define(metric.runs)) continue;
    if (metric.column == invariant_column) {
      for (const std::string& invariant : invariants_) {
        columns.push_back({.of = Of::invariant,
                           .name = invariant + std::string(drift_of_invariant),
                           .key = invariant,
                           .index = index(invariant_column)});
      }
    } else {
      columns.push_back({.of = Of::metric, .name = metric.column, .index = index(metric.column)});
    }
  }
  return columns;
}

OptionValue CellReader::value(const RunColumn& column, const RunPlace& run, const Value& stored) {
  switch (column.of) {
    case Of::run: return id_of_number(static_cast<std::uint64_t>(run.id));
    case Of::folder: return run.store->folder.string();
    case Of::metric: return value_of_store(stored);
    case Of::invariant: return number_of(column.key, stored);
    default: break;
  }
  const Configuration* configuration = configuration_of(run);
  if (!configuration) return {};
  const Configuration& options = *configuration;
  if (column.of == Of::option) {
    const auto found = options.find(column.key);
    if (found == options.end()) return {};
    if (names_ && column.key == "scenario") return names_->of(text_of(found->second), *run.store);
    return found->second;
  }
  const auto scenario = options.find("scenario");
  return scenario == options.end() ? OptionValue() : of_scenario(column.key, run, text_of(scenario->second));
}

const Configuration* CellReader::configuration_of(const RunPlace& run) {
  if (run.store != last_store_ || run.configuration != last_key_) {
    const auto found = run.store->configurations.find(run.configuration);
    last_ = found == run.store->configurations.end() ? nullptr : &found->second;
    last_store_ = run.store;
    last_key_ = run.configuration;
  }
  return last_;
}

const CellReader::Known& CellReader::known(const std::string& key, const OpenStore& store,
                                           const std::string& scenario) {
  const auto [at, is_new] = known_.try_emplace({&store, scenario, key});
  if (is_new) {
    try {
      const FoundKey found = source_of(store.scenarios, scenario).find({key, "", ""});
      at->second.path = found.path;
      if (found.value) at->second.value = cell_of_toml(in_toml(*found.value));
    } catch (const std::runtime_error&) {  // it stays without a path
    }
  }
  return at->second;
}

OptionValue CellReader::of_scenario(const std::string& key, const RunPlace& run, const std::string& scenario) {
  const Known& wanted = known(key, *run.store, scenario);
  OptionValue value = wanted.value;
  try {
    const std::vector<Override> varied = varied_of(std::string(run.varied));
    for (const Override& one : varied) {
      const std::string& path = one.key == key ? wanted.path : known(one.key, *run.store, scenario).path;
      if (path == wanted.path) {
        value = cell_of_toml(one.value);
      } else if (is_above(path, wanted.path) || is_above(wanted.path, path)) {
        TomlValue tree = parse_toml(run.store->scenarios.at(scenario).source);
        for (std::size_t k = 0; k < varied.size(); ++k) apply_override(tree, varied[k], static_cast<int>(k));
        const auto found = value_at(tree, wanted.path);
        return found ? cell_of_toml(in_toml(*found)) : OptionValue();
      }
    }
    return value;
  } catch (...) {
    return {};  // the row, or what it refers to, is damaged
  }
}

}  // namespace polhode::study::query
