// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/tables/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/report/answer/answer.hpp"
#include "experiments/study/text/aligned.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline report::inline tables {
namespace {

constexpr std::size_t most_rows = 100;  // largest number of rows that are all shown on the terminal
constexpr std::size_t rows_of_more = 40;
constexpr std::size_t most_reasons = 10;

/// The metrics with a column here, in the order of the tables of runs.
std::vector<const Metric*> shown_metrics(std::span<const Metric> metrics) {
  std::vector<const Metric*> shown = in_table_order(metrics);
  std::erase_if(shown, [](const Metric* metric) { return metric->terminal_label.empty(); });
  return shown;
}

std::string metric_cell(const Metric& metric, const RunResult& result) {
  if (metric.terminal_cell) return metric.terminal_cell(result);
  std::string text;
  with_value(metric, result, [&]<class Value>(const Value& value) {
    if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (value) text = fmt::format("{:.3g}", *value);
    } else {
      text = table_cell(metric, result);
    }
  });
  return text.empty() ? "-" : text;
}

bool has_role(const std::string& column, RunOption::Role role) {
  const RunOption* option = option_of_column(column);
  return option && option->role == role;
}

/// The columns of the configuration that differ between runs, and always the method and its step or tolerance.
std::vector<std::size_t> shown_columns(const std::vector<std::vector<std::string>>& cells,
                                       const std::vector<std::string>& names) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool always = has_role(names[k], RunOption::Role::method);
    const bool differs = std::any_of(cells.begin(), cells.end(), [&](const auto& c) { return c[k] != cells[0][k]; });
    const bool size = has_role(names[k], RunOption::Role::size) && !cells[0][k].empty();
    if (always || differs || size) shown.push_back(k);
  }
  return shown;
}

/// Indices of the runs to show: all, or evenly spread ones.
std::vector<std::size_t> shown_rows(std::size_t n) {
  std::vector<std::size_t> rows;
  const std::size_t m = n <= most_rows ? n : rows_of_more;
  for (std::size_t i = 0; i < m; ++i) rows.push_back(m == n ? i : i * (n - 1) / (m - 1));
  return rows;
}

/// Note on rows left out: "(40 of 120 runs, evenly spread; the other 80 are in runs.csv)"; empty if all are shown.
std::string left_out(std::size_t n, const char* what, const std::string& where) {
  if (n <= most_rows) return {};
  return fmt::format("({} of {} {}, evenly spread; the other {} are in {})\n", rows_of_more, n, what, n - rows_of_more,
                     where);
}

std::string plain(const Table& table) {
  std::vector<std::vector<std::string>> cells(1);
  std::vector<bool> left;
  for (const auto& column : table.columns) {
    cells[0].push_back(column.unit.empty() ? column.header : fmt::format("{} ({})", column.header, column.unit));
    left.push_back(column.kind != Column::Kind::number);
  }
  for (const std::size_t i : shown_rows(table.rows.size())) {
    auto& row = cells.emplace_back(table.rows[i]);
    for (auto& cell : row) {
      if (cell.empty()) cell = "-";
    }
  }
  return aligned(cells, left);
}

/// Reasons for which runs were refused or failed.
std::string reasons_of(const StudyView& study) {
  std::vector<Unfinished> runs;
  for (const RunRecord& run : study.runs) {
    if (run.result.status == "refused" || run.result.status == "failed")
      runs.push_back({run.result.status, run.result.message});
  }
  const std::string text = reasons(runs);
  return text.empty() ? "" : "\n" + text;
}

std::string paragraphs(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "\n" + sentence + "\n";
  return text;
}

/// Summary of the analysis of the experiment, which replaces the table of runs.
std::string analysis_summary(const Analysis& analysis) {
  std::string text;
  if (!analysis.tables.empty()) {
    const Table& table = analysis.tables.front().table;
    text += plain(table);
    text += left_out(table.rows.size(), "rows", "tables/" + analysis.tables.front().name + ".md");
  }
  for (const auto* sentences : {&analysis.sentences, &analysis.timed.sentences, &analysis.answer.sentences})
    text += paragraphs(*sentences);
  return text;
}

}  // namespace

std::string summary_table(const StudyView& study) {
  // If the report shows the analysis alone, its table contains the refused runs.
  if (study.analysis) return analysis_summary(*study.analysis) + (study.analysis->alone ? "" : reasons_of(study));
  const std::vector<std::string> names = config_columns(study.varied_keys, study.named);
  std::vector<std::vector<std::string>> cells;
  for (const RunRecord& run : study.runs) cells.push_back(config_cells(run.config, study.named));
  const auto columns = shown_columns(cells, names);
  std::vector<std::vector<std::string>> table(1);
  for (const std::size_t k : columns) table[0].push_back(names[k]);
  const auto metrics = shown_metrics(study.metrics);
  for (const Metric* metric : metrics) table[0].push_back(metric->terminal_label);
  const auto rows = shown_rows(study.runs.size());
  for (const std::size_t i : rows) {
    auto& row = table.emplace_back();
    for (const std::size_t k : columns) row.push_back(rounded(cells[i][k]));
    for (const Metric* metric : metrics) row.push_back(metric_cell(*metric, study.runs[i].result));
  }
  std::vector<bool> left;
  for (const std::size_t k : columns) left.push_back(!has_role(names[k], RunOption::Role::size));
  for (const Metric* metric : metrics) left.push_back(is_text(*metric));
  std::string text = aligned(table, left);
  return text + left_out(study.runs.size(), "runs", "runs.csv") + reasons_of(study) +
         paragraphs(answer_of(study, group(study)).sentences);
}

std::string reasons(const std::vector<Unfinished>& runs) {
  std::vector<std::pair<Unfinished, std::size_t>> found;  // each once, with its count
  for (Unfinished run : runs) {
    run.message = run.message.substr(0, run.message.find(" at t = "));  // the time differs from run to run
    const auto same = [&](const auto& f) { return f.first.status == run.status && f.first.message == run.message; };
    const auto known = std::find_if(found.begin(), found.end(), same);
    if (known == found.end()) found.emplace_back(std::move(run), 1);
    else ++known->second;
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(found.size(), most_reasons); ++i) {
    text += fmt::format("{} {}: {}\n", count(found[i].second, "run"), found[i].first.status, found[i].first.message);
  }
  if (found.size() > most_reasons) {
    text += fmt::format("… and {} more; all are in the column message of runs.csv\n",
                        count(found.size() - most_reasons, "reason"));
  }
  return text;
}

}  // namespace polhode::study::report::tables
