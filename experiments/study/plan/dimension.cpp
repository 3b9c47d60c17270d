// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/dimension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/plan/distribution.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

using Values = std::vector<OptionValue>;

DimensionKey key_of(const std::string& name, const std::string& label) {
  return {is_option(name) ? &run_option(name) : nullptr, name, label};
}

Values values_of_scenario_key(const std::string& text, const std::string& label) {
  Values values;
  for (std::string& value : toml_values(text, label)) values.emplace_back(std::move(value));
  return values;
}

/// A dimension of lists of equal lengths, one for each key.
void set_lists(Dimension& dimension, std::vector<Values> lists) {
  dimension.size = lists.front().size();
  dimension.value = [kept = std::make_shared<const std::vector<Values>>(std::move(lists))](
                        std::size_t point, std::size_t key) { return (*kept)[key][point]; };
}

Dimension axis_of(const RunOption& option, const std::string& text, const std::string& label, bool counted) {
  Dimension dimension{{{&option, option.name, label}}};
  if (counted && option.kind != RunOption::Kind::name) dimension.size = count_values(text);
  else set_lists(dimension, {axis_values(option, text, label)});
  return dimension;
}

Dimension axis_of(const std::string& key, const std::string& text, const std::string& place, bool counted) {
  Dimension dimension{{{nullptr, key, place}}};
  if (counted) dimension.size = count_values(text);
  else set_lists(dimension, {values_of_scenario_key(text, place.empty() ? "--vary " + key : place)});
  return dimension;
}

Dimension zip_of(const PointTable& table) {
  Dimension dimension;
  std::vector<Values> lists;
  for (const PointColumn& column : table.columns) {
    dimension.keys.push_back(key_of(column.key, column.label));
    const RunOption* option = dimension.keys.back().option;
    lists.push_back(option ? option_values(*option, column.text, column.label)
                           : values_of_scenario_key(column.text, column.label));
    if (lists.back().size() == lists.front().size()) continue;
    throw InputError(fmt::format("{}: {} of {}, but {} of {}; give each key as many", column.label,
                                 count(lists.back().size(), "value"), column.key, lists.front().size(),
                                 table.columns.front().key));
  }
  set_lists(dimension, std::move(lists));
  return dimension;
}

Dimension random_of(const PointTable& table) {
  Dimension dimension{{}, table.n};
  std::vector<Distribution> distributions;
  for (const PointColumn& column : table.columns) {
    dimension.keys.push_back(key_of(column.key, column.label));
    distributions.push_back(Distribution::parse(column.text, dimension.keys.back().option, column.label));
  }
  dimension.value = [keys = dimension.keys, distributions, seed = table.seed](std::size_t point, std::size_t key) {
    return distributions[key].draw(seed, keys[key].name, static_cast<std::uint32_t>(point));
  };
  return dimension;
}

Dimension cells_of(const PointTable& table) {
  Dimension dimension{{}, table.file->rows()};
  std::vector<std::size_t> columns;
  for (const PointColumn& column : table.columns) {
    dimension.keys.push_back(key_of(column.key, column.label));
    columns.push_back(table.file->column(column.key));
  }
  dimension.place = [file = table.file, columns](std::size_t row, std::size_t key) {
    return file->place(row, columns[key]);
  };
  dimension.value = [file = table.file, columns, keys = dimension.keys](std::size_t row,
                                                                        std::size_t key) -> OptionValue {
    const std::string text(file->text(row, columns[key]));
    if (text.empty()) return {};
    if (const RunOption* option = keys[key].option) return option_values(*option, text, keys[key].label).front();
    const Values values = values_of_scenario_key(text, file->place(row, columns[key]));
    if (values.size() == 1) return values.front();
    throw InputError(file->place(row, columns[key]) + " has several values; give one in each row");
  };
  return dimension;
}

Dimension dimension_of(const PointTable& table) {
  switch (table.kind) {
    case PointTable::Kind::zip: return zip_of(table);
    case PointTable::Kind::random: return random_of(table);
    case PointTable::Kind::cells: break;
  }
  return cells_of(table);
}

/// The slower a dimension is, the more expensive its change: a scenario is read again for each of its variants.
int rank(const Dimension& dimension) {
  const auto has_scenario = [](const DimensionKey& key) {
    return key.option && key.option->role == RunOption::Role::scenario;
  };
  if (std::any_of(dimension.keys.begin(), dimension.keys.end(), has_scenario)) return 0;
  return std::any_of(dimension.keys.begin(), dimension.keys.end(), [](const auto& key) { return !key.option; }) ? 1 : 2;
}

}  // namespace

std::vector<Dimension> dimensions(const StudyAxes& study, bool counted) {
  std::vector<Dimension> all;
  auto vary = study.vary;
  std::sort(vary.begin(), vary.end());
  for (const auto& [key, text] : vary) {
    if (study.table_with(key)) continue;
    const auto place = study.places.find("vary." + key);
    all.push_back(axis_of(key, text, place == study.places.end() ? "" : place->second, counted));
  }
  for (const RunOption& option : run_options()) {
    const auto text = study.axes.find(option.name);
    if (text == study.axes.end() || study.table_with(option.name)) continue;
    all.push_back(axis_of(option, text->second, study.label(option.name), counted));
  }
  for (const PointTable& table : study.tables) {
    all.push_back(dimension_of(table));
    all.back().word = word(table.kind);
  }
  std::stable_sort(all.begin(), all.end(), [](const Dimension& a, const Dimension& b) { return rank(a) < rank(b); });
  return all;
}

}  // namespace polhode::study::plan
