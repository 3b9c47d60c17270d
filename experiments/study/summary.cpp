// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/study/axes.hpp"
#include "experiments/study/plan.hpp"
#include "experiments/study/report/notation.hpp"

namespace polhode::study {
namespace {

constexpr std::size_t most_rows = 40;

std::string number(const std::optional<double>& x) { return x ? fmt::format("{:.3g}", *x) : "-"; }

/// The columns of the configuration that differ between runs, and always the method and its step or tolerance.
std::vector<std::size_t> shown_columns(const std::vector<std::vector<std::string>>& cells,
                                       const std::vector<std::string>& names) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool always = names[k] == "integrator";
    const bool differs = std::any_of(cells.begin(), cells.end(), [&](const auto& c) { return c[k] != cells[0][k]; });
    const bool size = (names[k] == "dt_s" || names[k] == "tolerance") && !cells[0][k].empty();
    if (always || differs || size) shown.push_back(k);
  }
  return shown;
}

/// Runs to show: all, or evenly spread ones.
std::vector<std::size_t> shown_rows(std::size_t n) {
  std::vector<std::size_t> rows;
  const std::size_t m = std::min(n, most_rows);
  for (std::size_t i = 0; i < m; ++i) rows.push_back(m == n ? i : i * (n - 1) / (m - 1));
  return rows;
}

/// Columns of equal width, on the left or on the right.
std::string aligned(const std::vector<std::vector<std::string>>& table, const std::vector<bool>& left) {
  std::vector<std::size_t> width(table[0].size());
  for (const auto& row : table) {
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], report::length(row[k]));
  }
  std::string text;
  for (const auto& row : table) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string blanks(width[k] - report::length(row[k]), ' ');
      text += (left[k] ? row[k] + blanks : blanks + row[k]) + "  ";
    }
    while (text.back() == ' ') text.pop_back();
    text += '\n';
  }
  return text;
}

std::string plain(const report::Table& table) {
  std::vector<std::vector<std::string>> cells(1);
  std::vector<bool> left;
  for (const auto& column : table.columns) {
    cells[0].push_back(column.unit.empty() ? column.header : fmt::format("{} ({})", column.header, column.unit));
    left.push_back(column.kind != report::Column::Kind::number);
  }
  for (const std::size_t i : shown_rows(table.rows.size())) {
    auto& row = cells.emplace_back(table.rows[i]);
    for (auto& cell : row) {
      if (cell.empty()) cell = "-";
    }
  }
  return aligned(cells, left);
}

/// The answer of the experiment in place of the table of runs.
std::string analysis_summary(const Analysis& analysis) {
  std::string text;
  if (!analysis.tables.empty()) {
    const report::Table& table = analysis.tables.front().table;
    text += plain(table);
    if (table.rows.size() > most_rows) {
      text += fmt::format("({} of {} rows, evenly spread; all are in tables/{}.md)\n", most_rows, table.rows.size(),
                          analysis.tables.front().name);
    }
  }
  for (const auto* sentences : {&analysis.sentences, &analysis.timed.sentences}) {
    for (const std::string& sentence : *sentences) text += "\n" + sentence + "\n";
  }
  return text;
}

}  // namespace

std::string summary_table(const StudyView& study) {
  if (study.analysis) return analysis_summary(*study.analysis);
  const std::vector<std::string> names = config_columns(study.varied_keys, study.named);
  std::vector<std::vector<std::string>> cells;
  for (const RunRecord& run : study.runs) cells.push_back(config_cells(run.config));
  const auto columns = shown_columns(cells, names);
  std::vector<std::vector<std::string>> table(1);
  for (const std::size_t k : columns) table[0].push_back(names[k]);
  for (const char* h : {"status", "energy drift", "its class", "ang. momentum", "defect", "attitude rad"}) table[0].emplace_back(h);
  const auto rows = shown_rows(study.runs.size());
  for (const std::size_t i : rows) {
    const RunResult& r = study.runs[i].result;
    auto& row = table.emplace_back();
    for (const std::size_t k : columns) row.push_back(cells[i][k]);
    row.push_back(r.status);
    row.push_back(number(r.energy_drift_max_rel));
    row.push_back(r.drift_class.empty()     ? "-"
                  : r.drift_decided_after ? fmt::format("{} (try {} s)", r.drift_class, report::number(*r.drift_decided_after, 2))
                                          : r.drift_class);
    for (const auto& x : {r.angular_momentum_drift_max_rel, r.orientation_defect_max, r.attitude_error_max}) {
      row.push_back(number(x));
    }
  }
  std::vector<bool> left;
  for (std::size_t k = 0; k < table[0].size(); ++k) {
    left.push_back(k == columns.size() || k == columns.size() + 2 ||
                   (k < columns.size() && names[columns[k]] != "dt_s" && names[columns[k]] != "tolerance"));
  }
  std::string text = aligned(table, left);
  if (rows.size() < study.runs.size()) {
    text += fmt::format("({} of {} runs, evenly spread; all are in runs.csv)\n", rows.size(), study.runs.size());
  }
  return text;
}

}  // namespace polhode::study
