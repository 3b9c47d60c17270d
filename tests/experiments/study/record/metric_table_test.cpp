// SPDX-License-Identifier: BSD-3-Clause
// The table of metrics: one more entry is found wherever results are kept, written and explained, and every value comes
// back from the store.
#include "experiments/study/record/metric_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/judge/judgement.hpp"
#include "experiments/study/plan/listing.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/report/tables/results.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/store/store.hpp"
#include "tests/experiments/study/store/loaded.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::metric_table_test {
namespace {

/// The metric of this test, one entry,
std::vector<Metric> with_step_rate() {
  std::vector<Metric> metrics = metric_table();
  metrics.push_back({.column = "step_rate_per_s",
                     .meaning = "steps in a second of the motion",
                     .label = "pace",
                     .unit = "1/s",
                     .in_summary = true,
                     .terminal_label = "pace on the terminal",
                     .tex = "StepRate",
                     .judge_label = "step rate"});
  return metrics;
}

/// and the code that measures it.
void measure_step_rate(RunResult& result) {
  result.further["step_rate_per_s"] = static_cast<double>(result.steps) / result.t_reached;
}

RunRecord measured_run() {
  const Scenario scenario = ScenarioSource::open("oscillator").resolve();
  RunRecord run;
  run.id = "0123456789abcdef";
  run.config.scenario = scenario.name;
  run.config.integrator = "rk4";
  run.config.dt = 0.125;
  run.config.t_end = 4;
  run.result = carry_out(run.config, scenario, {}, nullptr);
  measure_step_rate(run.result);
  return run;
}

std::string text_of_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The lines of the text that contain the part.
std::string lines_with(const std::string& part, const std::string& text) {
  std::istringstream in(text);
  std::string found;
  for (std::string line; std::getline(in, line);) {
    if (line.find(part) != std::string::npos) found += line + "\n";
  }
  return found;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(MetricTable, OneMoreEntryIsFoundInStoreTablesHelpAndCsv) {
  const std::vector<Metric> metrics = with_step_rate();
  const TemporaryFolder folder;
  StudyView study;
  study.experiment = "energy_drift";
  study.question = "How many steps?";
  study.folder = folder.path();
  study.metrics = metrics;
  study.runs.push_back(measured_run());
  ASSERT_EQ(study.runs[0].result.status, "ok") << study.runs[0].result.message;

  Store(folder.path(), metrics).keep(study.runs);
  const Loaded loaded = load(Store(folder.path(), metrics));
  ASSERT_TRUE(loaded.runs.contains(study.runs[0].id));
  study.runs[0].result = loaded.runs.at(study.runs[0].id);
  ASSERT_TRUE(study.runs[0].result.further.contains("step_rate_per_s"));
  EXPECT_EQ(study.runs[0].result.further.at("step_rate_per_s"), 8);

  write_runs_csv(study);
  const std::string csv = text_of_file(folder.path() / "runs.csv");
  const auto header = cells_of(csv.substr(0, csv.find('\n')));
  const auto column = std::find(header.begin(), header.end(), "step_rate_per_s");
  ASSERT_NE(column, header.end()) << csv;
  const auto row = cells_of(lines_with(study.runs[0].id, csv));
  EXPECT_EQ(std::stod(row.at(static_cast<std::size_t>(column - header.begin()))), 8);

  write_tables(study);
  const std::string markdown = text_of_file(folder.path() / "tables" / "summary.md");
  EXPECT_NE(markdown.find("pace (1/s)"), std::string::npos) << markdown;
  EXPECT_NE(lines_with("| rk4", markdown).find("| 8 "), std::string::npos) << markdown;
  EXPECT_NE(text_of_file(folder.path() / "tables" / "summary.tex").find("pace"), std::string::npos);
  const std::string values = text_of_file(folder.path() / "tables" / "values.tex");
  EXPECT_NE(lines_with("StepRate}", values).find("{8}"), std::string::npos) << values;

  const std::string terminal = summary_table(study);
  EXPECT_NE(terminal.find("pace on the terminal\n"), std::string::npos) << terminal;
  EXPECT_NE(terminal.find(" 8\n"), std::string::npos) << terminal;

  const std::string help = lines_with("step_rate_per_s", listing("metrics", metrics));
  EXPECT_NE(help.find("steps in a second of the motion"), std::string::npos) << help;
  EXPECT_EQ(lines_with("step_rate_per_s", listing("", metrics)), help);

  judge::Judged judged;
  judged.score.record = study.runs[0];
  const Analysis analysis = judge::judgement(study, {judged});
  const auto& columns = analysis.tables.at(0).table.columns;
  const auto shown =
      std::find_if(columns.begin(), columns.end(), [](const auto& c) { return c.header == "step rate"; });
  ASSERT_NE(shown, columns.end());
  EXPECT_EQ(analysis.tables[0].table.rows.at(0).at(static_cast<std::size_t>(shown - columns.begin())), "8");
  const auto scores = std::find_if(analysis.files.begin(), analysis.files.end(),
                                   [](const auto& file) { return file.name == "scores.csv"; });
  ASSERT_NE(scores, analysis.files.end());
  EXPECT_NE(scores->text.find(",step_rate_per_s,"), std::string::npos) << scores->text;
}

TEST(MetricTable, AStoreOfAnotherTableIsRefused) {
  const std::vector<Metric> metrics = with_step_rate();
  const TemporaryFolder folder;
  Store(folder.path(), metrics).keep({});
  EXPECT_NO_THROW(Store::ids_in(folder.path(), metrics));
  try {
    Store::ids_in(folder.path());
    FAIL() << "it is read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("has the further column step_rate_per_s, so it is not that of this version of polhode"),
              std::string::npos)
        << error.what();
  }
}

TEST(MetricTable, ANumberWithoutAnEntryIsRefused) {
  const TemporaryFolder folder;
  const std::vector<RunRecord> runs = {measured_run()};
  EXPECT_THROW(Store(folder.path()).keep(runs), std::logic_error);
}

TEST(MetricTable, EveryValueComesBackFromTheStore) {
  RunRecord run;
  run.id = "0123456789abcdef";
  double next = 0.1;
  for (const Metric& metric : metric_table()) {
    with_value(metric, run.result, [&]<class Value>(Value& value) {
      if constexpr (std::is_same_v<Value, std::string>)
        value = metric.words.empty() ? "text of " + metric.column : metric.words.back();
      else if constexpr (std::is_same_v<Value, std::int64_t>) value = static_cast<std::int64_t>(next * 1e12);
      else if constexpr (std::is_same_v<Value, std::optional<double>>) value = next;
      else value = {{"p_phi", next}, {"p_psi", -next}};
    });
    next *= 1.7;
  }
  run.result.status = "diverged";
  run.result.position_reference = std::numeric_limits<double>::infinity();
  run.result.attitude_reference.reset();
  run.result.t_reached = 0.3;
  run.result.seconds = 0.7;
  run.result.series = {{0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}};
  run.result.attitude_errors = {{0.1, 0.2}};
  const TemporaryFolder folder;
  Store(folder.path()).keep({&run, 1});
  const Loaded loaded = load(Store(folder.path()));
  ASSERT_TRUE(loaded.damaged.empty()) << loaded.damaged.begin()->second;
  const RunResult& back = loaded.runs.at(run.id);
  for (const Metric& metric : metric_table()) {
    with_value(metric, run.result, [&]<class Value>(const Value& kept) {
      with_value(metric, back, [&]<class Other>(const Other& read) {
        if constexpr (std::is_same_v<Value, Other>) EXPECT_EQ(kept, read) << metric.column;
        else ADD_FAILURE() << metric.column;
      });
    });
  }
  EXPECT_EQ(back.t_reached, 0.3);
  EXPECT_EQ(back.seconds, 0.7);
  ASSERT_EQ(back.series.size(), 2u);
  EXPECT_EQ(back.series[1].orientation_defect, 9);
  ASSERT_EQ(back.attitude_errors.size(), 1u);
  EXPECT_EQ(back.attitude_errors[0].error_rad, 0.2);
}

TEST(MetricTable, ColumnsAreIdentifiersAndEachStandsOnce) {
  std::set<std::string> seen;
  for (const Metric& metric : metric_table()) {
    EXPECT_TRUE(std::all_of(metric.column.begin(), metric.column.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '_';
    })) << metric.column;
    EXPECT_TRUE(seen.insert(metric.column).second) << metric.column;
    // The column ends with the unit that tables print.
    std::string ending = metric.unit == "relative" ? "_rel" : "_" + metric.unit;
    if (const std::size_t per = ending.find('/'); per != std::string::npos) ending.replace(per, 1, "_per_");
    std::replace(ending.begin(), ending.end(), ' ', '_');
    if (metric.unit.empty() || metric.unit == "1") continue;
    EXPECT_TRUE(metric.column.ends_with(ending)) << metric.column;
  }
}

TEST(MetricTable, NoMetricHasTheColumnOfAnOption) {
  std::set<std::string> of_options;
  for (const RunOption& option : run_options()) of_options.insert(option.column);
  ASSERT_TRUE(of_options.contains("iterations"));
  for (const Metric& metric : metric_table()) EXPECT_FALSE(of_options.contains(metric.column)) << metric.column;
}

TEST(MetricTable, EachMetricHasALineInTheListOrSharesThatOfAnother) {
  const std::vector<Metric>& metrics = metric_table();
  for (const Metric& metric : metrics) {
    EXPECT_NE(metric.meaning.empty(), metric.listed_with.empty()) << metric.column;
    const std::string with = metric.listed_with.empty() ? metric.column : metric.listed_with;
    const auto found = std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.column == with; });
    ASSERT_NE(found, metrics.end()) << metric.column;
    EXPECT_FALSE(found->meaning.empty()) << metric.column;
    const std::string name = found->listed_as.empty() ? found->column : found->listed_as;
    EXPECT_NE(listing("metrics").find("  " + name + " "), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace polhode::study::metric_table_test
