// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/study_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <string_view>
#include <system_error>

#include "experiments/study/plan/most_runs.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"

namespace polhode::study::inline plan {
namespace {

void refuse_twice(const StudyAxes& study, const std::string& key, const std::string& label) {
  if (!study.has(key)) return;
  const auto varied = study.places.find("vary." + key);
  const std::string other = varied == study.places.end() ? study.label(key) : varied->second;
  throw InputError(label + ": " + key + " is given twice, also by " + other + "; leave one out");
}

}  // namespace

std::string word(PointTable::Kind kind) {
  switch (kind) {
    case PointTable::Kind::zip: return "zip";
    case PointTable::Kind::random: return "random";
    case PointTable::Kind::cells: break;
  }
  return "cells";
}

std::string words(const PointTable& table) {
  if (table.kind == PointTable::Kind::cells) return table.file->path();
  std::string text = table.kind == PointTable::Kind::random ? fmt::format("n={} seed={}", table.n, table.seed) : "";
  for (const PointColumn& column : table.columns) text += (text.empty() ? "" : " ") + column.key + "=" + column.text;
  return text;
}

std::string StudyAxes::label(const std::string& option) const {
  if (const PointTable* table = table_with(option)) {
    for (const PointColumn& column : table->columns) {
      if (column.key == option) return column.label;
    }
  }
  const auto found = places.find(option);
  return found == places.end() ? "--" + option : found->second;
}

const PointTable* StudyAxes::table_with(const std::string& key) const {
  for (const PointTable& table : tables) {
    const auto has = [&](const PointColumn& column) { return column.key == key; };
    if (std::any_of(table.columns.begin(), table.columns.end(), has)) return &table;
  }
  return nullptr;
}

bool StudyAxes::has(const std::string& key) const {
  const auto varied = [&](const auto& v) { return v.first == key; };
  return axes.contains(key) || table_with(key) || std::any_of(vary.begin(), vary.end(), varied);
}

void StudyAxes::add_axis(const std::string& key, const std::string& text, const std::string& label, bool of_scenario) {
  const bool option = !of_scenario && is_option(key);
  refuse_twice(*this, key, label);
  places[option ? key : "vary." + key] = label;
  if (!option) return void(vary.emplace_back(key, text));
  axes[key] = text;
  said.insert(key);
}

void StudyAxes::add_table(PointTable table) {
  std::set<std::string> own;
  for (const PointColumn& column : table.columns) {
    refuse_twice(*this, column.key, column.label);
    if (!own.insert(column.key).second)
      throw InputError(column.label + ": " + column.key + " is given twice; leave one out");
    if (is_option(column.key)) said.insert(column.key);
  }
  tables.push_back(std::move(table));
}

void StudyAxes::remove(const std::string& key) {
  axes.erase(key);
  said.erase(key);
  places.erase(key);
  places.erase("vary." + key);
  std::erase_if(vary, [&](const auto& v) { return v.first == key; });
  for (PointTable& table : tables) {
    std::erase_if(table.columns, [&](const PointColumn& column) { return column.key == key; });
  }
  std::erase_if(tables, [](const PointTable& table) { return table.columns.empty(); });
}

bool is_option(const std::string& key) {
  const auto& all = run_options();
  return std::any_of(all.begin(), all.end(),
                     [&](const RunOption& option) { return option.name == key && is_axis(option); });
}

std::size_t number_of_points(double n, const std::string& label) {
  if (n >= 1 && n == std::floor(n) && n <= static_cast<double>(most_runs)) return static_cast<std::size_t>(n);
  throw InputError(fmt::format("{}: {} points; n must be a whole number from 1 to 10 million", label, n));
}

std::uint64_t seed_from(double seed, const std::string& label) {
  if (seed >= 0 && seed == std::floor(seed) && seed <= 0x1p53) return static_cast<std::uint64_t>(seed);
  throw InputError(fmt::format("{}: {} is no seed; it must be a whole number from 0 to 9007199254740992", label, seed));
}

PointTable table_of_cells(const std::string& path, const std::string& label) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw InputError(fmt::format("{}: there is no file {}", label, path));
  PointTable table{.kind = PointTable::Kind::cells, .label = label, .columns = {}, .file = CellsFile::read(path)};
  for (std::size_t i = 0; i < table.file->keys().size(); ++i)
    table.columns.push_back({table.file->keys()[i], "", table.file->labels()[i]});
  return table;
}

namespace {

/// True for options of the command line that belong to one call, and not to a study.
bool belongs_to_call(std::string_view name) {
  constexpr std::string_view others[] = {
      "study",  "out",          "force",       "trajectory",   "curves",          "article", "no-figures",
      "figure", "figure-width", "figure-font", "figure-title", "figure-language", "jobs",    "seed",
      "shard",  "merge",        "slurm",       "submit",       "dry-run",         "list"};
  const auto of_runs = options_of_role(RunOption::Role::call);
  return std::find(std::begin(others), std::end(others), name) != std::end(others) ||
         std::any_of(of_runs.begin(), of_runs.end(), [&](const RunOption* option) { return option->name == name; });
}

}  // namespace

std::string axis_key(const std::string& written, const std::string& label) {
  std::string name = written;
  std::replace(name.begin(), name.end(), '_', '-');
  if (is_option(name)) return name;
  if (written.find('.') != std::string::npos || find_key(root_keys(), written)) return written;
  std::vector<std::string_view> known;
  for (const RunOption& option : run_options()) {
    if (is_axis(option)) known.push_back(option.name);
  }
  if (belongs_to_call(name)) throw InputError(label + ": is no axis; give it on the command line, as --" + name);
  throw InputError(label + ": no such axis" + suggestion(name, "There are", known) +
                   ", and the keys of the scenario, such as body.0.mass");
}

}  // namespace polhode::study::plan
