// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

#include "experiments/results/listing.hpp"
#include "experiments/results/output.hpp"
#include "experiments/study/query/selection.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/suggestion.hpp"

namespace polhode::study::results {
namespace {

constexpr std::pair<std::string_view, Measure> measures[] = {{"count", Measure::count},   {"min", Measure::min},
                                                             {"max", Measure::max},       {"mean", Measure::mean},
                                                             {"median", Measure::median}, {"sum", Measure::sum}};

/// One column of --show.
struct Shown {
  std::string name;  ///< name as it was given
  Measure measure = Measure::count;
  std::optional<RunColumn> column;  ///< column that is shown; absent: the number of runs
};

Shown shown_of(const std::string& said, const RunColumns& columns) {
  const std::size_t colon = said.find(':');
  const std::string word = said.substr(0, colon);
  const auto found =
      std::find_if(std::begin(measures), std::end(measures), [&](const auto& m) { return m.first == word; });
  if (found == std::end(measures)) {
    std::vector<std::string_view> words;
    for (const auto& [known, measure] : measures) words.push_back(known);
    throw InputError("--show " + said + ": there is no '" + word + "'" + suggestion(word, "There are", words));
  }
  if (colon == std::string::npos && found->second != Measure::count)
    throw InputError("--show " + said + ": of which column? Write " + said + ":COLUMN");
  Shown shown{said, found->second, {}};
  if (colon != std::string::npos) shown.column = columns.find(said.substr(colon + 1), "--show");
  return shown;
}

struct Group {
  std::int64_t runs = 0;
  std::vector<std::vector<double>> values;  ///< values for each column of --show
};

/// Sorts rows by the columns that --sort names.
void sort_rows(std::vector<std::vector<OptionValue>>& rows, const std::vector<std::string>& names,
               const std::vector<std::string>& said) {
  std::vector<std::pair<std::size_t, bool>> keys;
  for (const std::string& key : said) {
    const bool descending = key.starts_with('-');
    const std::string name = key.substr(descending ? 1 : 0);
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw InputError("--sort: the groups have no column '" + name + "'" +
                       suggestion(name, "They have", {names.begin(), names.end()}));
    keys.emplace_back(static_cast<std::size_t>(at - names.begin()), descending);
  }
  std::stable_sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) {
    for (const auto& [k, descending] : keys) {
      const int sign = compare(a[k], b[k]);
      if (sign == 0) continue;
      const bool absent = a[k] == OptionValue() || b[k] == OptionValue();
      return descending && !absent ? sign > 0 : sign < 0;
    }
    return false;
  });
}

}  // namespace

bool RowLess::operator()(const std::vector<OptionValue>& a, const std::vector<OptionValue>& b) const {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (const int sign = compare(a[k], b[k])) return sign < 0;
  }
  return false;
}

std::optional<double> measured(Measure measure, std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  if (measure == Measure::count) return static_cast<double>(n);
  if (n == 0) return std::nullopt;
  switch (measure) {
    case Measure::min: return values.front();
    case Measure::max: return values.back();
    case Measure::median:
      return n % 2 == 1 ? values[n / 2] : values[n / 2 - 1] + (values[n / 2] - values[n / 2 - 1]) / 2;
    default: break;
  }
  double sum = 0, lost = 0;  // compensated (Neumaier)
  for (const double x : values) {
    const double next = sum + x;
    lost += std::abs(sum) >= std::abs(x) ? (sum - next) + x : (x - next) + sum;
    sum = next;
  }
  sum += lost;
  return measure == Measure::sum ? sum : sum / static_cast<double>(n);
}

int list_groups(const ResultStores& stores, const RunColumns& columns, std::span<const Where> conditions,
                const ResultsOptions& options) {
  std::vector<RunColumn> by;
  for (const std::string& name : options.group) by.push_back(columns.find(name, "--group"));
  std::vector<Shown> shown;
  for (const std::string& said : options.show) shown.push_back(shown_of(said, columns));
  if (shown.empty()) shown.push_back({"count", Measure::count, {}});

  const SelectedRuns selection = select(stores, columns, conditions, {}, Order::stored);
  std::map<std::vector<OptionValue>, Group, RowLess> groups;
  const ScenarioNames scenarios(stores);
  CellReader cells(scenarios);
  std::vector<OptionValue> key(by.size());
  const Damage damage = RunReader(stores).read(selection, [&](const CheckedRow& row) {
    const auto value = [&](const RunColumn& column) {
      return cells.value(column, row.place, column.in_store() ? row.values[column.index] : Value());
    };
    for (std::size_t k = 0; k < by.size(); ++k) key[k] = value(by[k]);
    Group& group = groups[key];
    group.values.resize(shown.size());
    ++group.runs;
    for (std::size_t k = 0; k < shown.size(); ++k) {
      if (!shown[k].column) continue;
      const OptionValue cell = value(*shown[k].column);
      if (const auto* x = std::get_if<double>(&cell)) group.values[k].push_back(*x);
      else if (const auto* n = std::get_if<std::int64_t>(&cell)) group.values[k].push_back(static_cast<double>(*n));
      else if (!std::holds_alternative<std::monostate>(cell) && shown[k].measure != Measure::count)
        throw InputError("--show " + shown[k].name + ": the column holds texts; count alone counts them");
      else if (!std::holds_alternative<std::monostate>(cell)) group.values[k].push_back(0);
    }
    return true;
  });

  std::vector<std::string> names;
  for (const RunColumn& column : by) names.push_back(column.name);
  for (const Shown& one : shown) names.push_back(one.name);
  std::vector<std::vector<OptionValue>> rows;
  for (auto& [values, group] : groups) {
    std::vector<OptionValue>& row = rows.emplace_back(values);
    for (std::size_t k = 0; k < shown.size(); ++k) {
      if (shown[k].measure == Measure::count) {
        row.emplace_back(shown[k].column ? static_cast<std::int64_t>(group.values[k].size()) : group.runs);
      } else if (const auto x = measured(shown[k].measure, group.values[k])) {
        row.emplace_back(*x);
      } else {
        row.emplace_back();
      }
    }
  }
  sort_rows(rows, names, options.sort);
  Output output(options.format.value_or(Format::table), options.out, names);
  for (std::size_t k = 0; k < rows.size() && k < options.limit.value_or(rows.size()); ++k) output.add(rows[k]);
  output.finish();
  return say_damage(damage);
}

}  // namespace polhode::study::results
