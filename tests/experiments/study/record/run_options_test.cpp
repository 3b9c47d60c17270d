// SPDX-License-Identifier: BSD-3-Clause
// A run option is one entry of the table: one that this test adds is found in the help, in study files, in the plan, in
// the identity of runs, in the store, in runs.csv, in the tables, in the figures and in the report.
#include "experiments/study/record/run_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/tables/run_table.hpp"
#include "experiments/study/report/tables/tex_values.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/study.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::run_options_test {
namespace {

using ::testing::HasSubstr;

/// The tidiness of a run. No code uses it.
RunOption tidiness() {
  RunOption option{.name = "tidy-up",
                   .values = "never|daily",
                   .help = "when the run tidies up (default: never)",
                   .column = "tidy_up",
                   .on_demand = true,
                   .header = "tidies up",
                   .word = "tidy",
                   .usual = std::string("never")};
  option.known = [] { return std::vector<std::string>{"never", "daily"}; };
  return without_member(option);
}

const Experiment short_study = {.name = "short_study",
                                .question = "Does a new option reach every place?",
                                .defaults = {{"scenario", "dzhanibekov"}, {"integrator", "rk4"}, {"dt", "0.01"}}};

std::vector<const char*> call(std::initializer_list<const char*> more) {
  std::vector<const char*> all = {"short_study", "--t-end", "0.05", "--no-figures"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Plan planned(std::initializer_list<const char*> more) {
  const auto words = call(more);
  return make_plan(short_study, parse_options(short_study, int(words.size()), words.data()).options);
}

std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// One run of each value, without results.
StudyView view_of(const Plan& plan) {
  StudyView view;
  view.named = plan.named;
  view.scenarios = plan.scenarios;
  for (const PlannedRun& run : plan.runs()) view.runs.push_back({run.id, run.config, {}, run.scenario});
  return view;
}

TEST(RunOptions, OneEntryIsAllThatTheCommandLineAndStudyFilesNeed) {
  const AddedRunOption added(tidiness());
  testing::internal::CaptureStdout();
  const auto words = call({"--help"});
  EXPECT_EQ(parse_options(short_study, int(words.size()), words.data()).exit_status, 0);
  const std::string help = testing::internal::GetCapturedStdout();
  EXPECT_THAT(help, HasSubstr("--tidy-up never|daily"));
  EXPECT_THAT(help, HasSubstr("when the run tidies up (default: never)"));

  const TemporaryFolder folder;
  const std::string file = (folder.path() / "study.toml").string();
  std::ofstream(file) << "tidy_up = [\"never\", \"daily\"]\n";
  EXPECT_EQ(planned({"--study", file.c_str()}).size(), 2u);
  try {
    planned({"--tidy-up", "dayly"});
    FAIL() << "an unknown value was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--tidy-up: no 'dayly'"));
  }
}

TEST(RunOptions, OneEntryMakesRunsOfTheirOwnAndLeavesOtherStudiesAlone) {
  const Plan before = planned({});
  const AddedRunOption added(tidiness());
  const Plan silent = planned({}), both = planned({"--tidy-up", "never,daily"});
  EXPECT_EQ(silent.identity, before.identity);
  EXPECT_EQ(config_columns({}, silent.named), config_columns({}, before.named));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both.run(1).id, before.run(0).id) << "what a run does anyway is the same run";
  EXPECT_NE(both.run(0).id, before.run(0).id);
  EXPECT_EQ(config_cells(both.run(0).config, both.named).back(), "daily");  // sorted by the value
  EXPECT_EQ(config_cells(both.run(1).config, both.named).back(), "never");
}

TEST(RunOptions, OneEntryIsFoundInTheStoreTheTablesTheFiguresAndTheReport) {
  const AddedRunOption added(tidiness());
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "results";
  const std::string out = folder.string();
  testing::internal::CaptureStdout();
  const auto words = call({"--tidy-up", "never,daily", "--out", out.c_str()});
  EXPECT_EQ(run_experiment(short_study, int(words.size()), words.data()), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("tidy_up"));

  CsvReader table((folder / "runs.csv").string());
  const std::size_t id = table.column("run"), tidy = table.column("tidy_up");
  std::vector<std::uint64_t> ids;
  std::set<std::string> values;
  while (table.next()) {
    ids.push_back(number_of_id(table.text(id)));
    values.insert(table.text(tidy));
  }
  EXPECT_EQ(values, (std::set<std::string>{"daily", "never"}));
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(Store::ids_in(folder), ids);
  EXPECT_THAT(contents(folder / "report.html"), HasSubstr("<dt>tidies up</dt><dd>daily, never</dd>"));
  EXPECT_THAT(contents(folder / "manifest.json"), HasSubstr("\"tidy-up\": \"never,daily\""));

  const StudyView view = view_of(planned({"--tidy-up", "never,daily"}));
  const auto all = evenly_spread(view.runs.size(), view.runs.size());
  EXPECT_THAT(html(run_table(view, Extent::all, all)), HasSubstr("tidies up"));
  EXPECT_EQ(group(view).variants, (std::vector<std::string>{"tidy daily", "tidy never"}));
  EXPECT_THAT(tex_names(view, all)[0], HasSubstr("TidyDaily"));
}

TEST(RunOptions, ValuesAreReadPrintedAndSetTheSameWay) {
  for (const RunOption& option : run_options()) {
    if (!option.known) continue;
    for (const std::string& name : option.known()) {
      RunConfig config;
      if (option.name == "impact-timing") config.contact.emplace();
      option.set(config, name);
      EXPECT_EQ(text_of(option.value(config)), name) << option.name;
    }
  }
}

// Among them the settings of methods, which are named where a method is.
TEST(RunOptions, NamesAndColumnsAreUnique) {
  std::set<std::string> names, columns;
  for (const RunOption& option : run_options()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_TRUE(option.column.empty() || columns.insert(option.column).second) << option.column;
  }
  EXPECT_TRUE(names.contains("order")) << "of arkode_erk";
}

TEST(RunOptions, RunsAreSortedByTheirNumbersAndNotByTheirDigits) {
  const Plan plan = planned({"--dt", "9e-3,0.01,1e-4", "--vary", "body.0.mass=9,10,1e1,100"});
  std::vector<std::string> order;
  for (const PlannedRun& run : plan.runs()) order.push_back(text_of(*run.config.dt) + " " + run.config.varied[0].value);
  EXPECT_EQ(order, (std::vector<std::string>{"1e-04 9", "1e-04 10", "1e-04 100", "0.009 9", "0.009 10", "0.009 100",
                                             "0.01 9", "0.01 10", "0.01 100"}));
}

}  // namespace
}  // namespace polhode::study::run_options_test
