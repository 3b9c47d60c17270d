// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/dimension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>

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

Glance glance(double x) { return {Glance::Kind::number, x}; }

/// Unknown for a text of the scenario that is no number: it may be quoted, or a list.
Glance glance(const OptionValue& value, bool of_option) {
  if (const auto* x = std::get_if<double>(&value)) return glance(*x);
  if (const auto* n = std::get_if<std::int64_t>(&value)) return glance(static_cast<double>(*n));
  const auto* text = std::get_if<std::string>(&value);
  if (!text) return {Glance::Kind::none};
  if (of_option) return {Glance::Kind::text, 0, *text};
  const auto x = to_number(*text);
  return x ? glance(*x) : Glance{};
}

/// glance() at each value of a list, which must outlive it.
std::vector<Glance> glances(const Values& values, bool of_option) {
  std::vector<Glance> all;
  for (const OptionValue& value : values) all.push_back(glance(value, of_option));
  return all;
}

/// A dimension of lists of equal lengths, one for each key.
void set_lists(Dimension& dimension, std::vector<Values> made) {
  struct Lists {
    std::vector<Values> values;
    std::vector<std::vector<Glance>> glances;
  };
  dimension.size = made.front().size();
  const auto lists = std::make_shared<Lists>();
  lists->values = std::move(made);
  for (std::size_t k = 0; k < lists->values.size(); ++k)
    lists->glances.push_back(glances(lists->values[k], dimension.keys[k].option != nullptr));
  dimension.value = [lists](std::size_t point, std::size_t key) { return lists->values[key][point]; };
  dimension.look = [lists](std::size_t point, std::size_t key) { return lists->glances[key][point]; };
}

/// A dimension of one key whose values are made of numbers, each when it is needed: a range may have a million.
void set_numbers(Dimension& dimension, std::vector<double> made, const std::function<OptionValue(double)>& value_of) {
  dimension.size = made.size();
  const auto numbers = std::make_shared<const std::vector<double>>(std::move(made));
  dimension.value = [numbers, value_of](std::size_t point, std::size_t) { return value_of((*numbers)[point]); };
  dimension.look = [numbers](std::size_t point, std::size_t) { return glance((*numbers)[point]); };
}

Dimension axis_of(const RunOption& option, const std::string& text, const std::string& label, bool counted) {
  Dimension dimension{{{&option, option.name, label}}};
  if (option.kind == RunOption::Kind::name) {
    set_lists(dimension, {axis_values(option, text, label)});
  } else if (counted) {
    dimension.size = count_values(text);
  } else {
    set_numbers(dimension, axis_numbers(option, text, label),
                [&option, label](double x) { return option_value(option, x, label); });
  }
  return dimension;
}

Dimension axis_of(const std::string& key, const std::string& text, const std::string& place, bool counted) {
  Dimension dimension{{{nullptr, key, place}}};
  const std::string label = place.empty() ? "--vary " + key : place;
  if (counted) dimension.size = count_values(text);
  else if (auto numbers = toml_numbers(text, label)) set_numbers(dimension, std::move(*numbers), exact);
  else set_lists(dimension, {values_of_scenario_key(text, label)});
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
  std::vector<std::vector<Glance>> choices(distributions.size());
  for (std::size_t k = 0; k < distributions.size(); ++k) {
    if (const auto* values = distributions[k].choices())
      choices[k] = glances(*values, dimension.keys[k].option != nullptr);
  }
  dimension.look = [keys = dimension.keys, distributions, choices, seed = table.seed](std::size_t point,
                                                                                      std::size_t key) -> Glance {
    const Distribution& distribution = distributions[key];
    const auto number_of_point = static_cast<std::uint32_t>(point);
    if (!choices[key].empty()) return choices[key][distribution.choice(seed, keys[key].name, number_of_point)];
    const auto x = distribution.number(seed, keys[key].name, number_of_point);
    return x ? glance(*x) : Glance{};
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
  dimension.look = [file = table.file, columns, keys = dimension.keys](std::size_t row, std::size_t key) -> Glance {
    const std::string_view text = file->text(row, columns[key]);
    if (text.empty()) return {Glance::Kind::none};
    const bool names = keys[key].option && keys[key].option->kind == RunOption::Kind::name;
    if (names && text.find_first_of(" \t") == std::string_view::npos) return {Glance::Kind::text, 0, text};
    const auto x = names ? std::nullopt : to_number(text);
    return x ? glance(*x) : Glance{};
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
