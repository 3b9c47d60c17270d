// SPDX-License-Identifier: BSD-3-Clause
// A run option is one entry of the table: one that this test adds is found in the help, in study files, in the plan, in
// the identity of runs, in the store, in runs.csv, in the tables, in the figures, in the report and in replays.
#include "experiments/study/record/run_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/replay/study_reader.hpp"
#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/query/stored_run.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/tables/run_table.hpp"
#include "experiments/study/report/tables/tex_values.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/study.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/experiments/study/record/tidiness.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::run_options_test {
namespace {

using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Pair;

/// The width of the brush of a run. No code uses it.
RunOption brush_width() {
  return without_member({.name = "brush-width",
                         .values = "X",
                         .help = "width of the brush, in m",
                         .kind = RunOption::Kind::number,
                         .of_unit = " of metres",
                         .column = "brush_width_m",
                         .on_demand = true,
                         .header = "brush",
                         .unit = "m"});
}

/// Options of a whole study. No code uses them.
RunOption swept() {
  return without_member({.name = "swept-before",
                         .values = "",
                         .help = "sweep before the run",
                         .kind = RunOption::Kind::flag,
                         .role = RunOption::Role::study,
                         .word = "swept_before"});
}
RunOption most_brooms() {
  return without_member({.name = "most-brooms",
                         .values = "N",
                         .help = "a run with more brooms has failed",
                         .kind = RunOption::Kind::whole,
                         .role = RunOption::Role::call,
                         .word = "most_brooms"});
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

/// The reason for which the plan is refused; empty: it is not.
std::string fault_of(std::initializer_list<const char*> more) {
  try {
    planned(more);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string help_of_short_study() {
  testing::internal::CaptureStdout();
  const auto words = call({"--help"});
  EXPECT_EQ(parse_options(short_study, int(words.size()), words.data()).exit_status, 0);
  return testing::internal::GetCapturedStdout();
}

/// Carries out the study and returns what it prints.
std::string carried_out(std::initializer_list<const char*> more) {
  testing::internal::CaptureStdout();
  const auto words = call(more);
  EXPECT_EQ(run_experiment(short_study, int(words.size()), words.data()), 0);
  return testing::internal::GetCapturedStdout();
}

/// The configurations of all runs of a folder by id, read back from the store. Each makes the id under which it stands.
std::map<std::string, RunConfig> stored_configs(const std::filesystem::path& folder) {
  const Store store(folder, metric_table(), Access::read);
  const auto configurations = store.configurations();
  const auto scenarios = store.scenarios();
  std::map<std::string, RunConfig> configs;
  for (const std::uint64_t number : store.ids()) {
    const std::string id = id_of_number(number);
    const std::optional<StoredRun> stored = store.find(id, Curves::without);
    if (!stored) throw std::runtime_error("the store has no run " + id);
    const ReadRun run = read_run(*stored, configurations, scenarios);
    EXPECT_EQ(run.version, results_version) << id;
    configs[id] = run.config;
  }
  return configs;
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
  const std::string help = help_of_short_study();
  EXPECT_THAT(help, HasSubstr("--tidy-up never|daily"));
  EXPECT_THAT(help, HasSubstr("when the run tidies up (default: never)"));

  const TemporaryFolder folder;
  const std::string file = (folder.path() / "study.toml").string();
  std::ofstream(file) << "tidy_up = [\"never\", \"daily\"]\n";
  EXPECT_EQ(planned({"--study", file.c_str()}).size(), 2u);
  EXPECT_THAT(fault_of({"--tidy-up", "dayly"}), HasSubstr("--tidy-up: no 'dayly'"));
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

TEST(RunOptions, OneEntryIsFoundInTheStoreTheTablesTheFiguresTheReportAndReplays) {
  const AddedRunOption added(tidiness()), second(brush_width());
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "results";
  const std::string out = folder.string();
  EXPECT_THAT(carried_out({"--tidy-up", "never,daily", "--brush-width", "0.1,0.25", "--trajectory", "csv", "--out",
                           out.c_str()}),
              HasSubstr("tidy_up"));

  using Values = std::pair<std::string, std::string>;
  const auto values_in = [](const RunConfig& config) {
    return Values(text_of(run_option("tidy-up").value(config)), text_of(run_option("brush-width").value(config)));
  };
  std::map<std::string, Values> values, stored, played;  // by id
  CsvReader table((folder / "runs.csv").string());
  const std::size_t id = table.column("run"), tidy = table.column("tidy_up"), brush = table.column("brush_width_m");
  while (table.next()) values[table.text(id)] = {table.text(tidy), table.text(brush)};
  std::set<Values> different;
  for (const auto& [run, said] : values) different.insert(said);
  EXPECT_EQ(different, (std::set<Values>{{"daily", "0.1"}, {"daily", "0.25"}, {"never", "0.1"}, {"never", "0.25"}}));
  for (const auto& [run, config] : stored_configs(folder)) {
    stored[run] = values_in(config);
    const auto parts = identity_parts(config);
    EXPECT_THAT(parts, Contains(Pair("brush_width_m", stored[run].second)));
    if (stored[run].first == "daily") {
      EXPECT_THAT(parts, Contains(Pair("tidy_up", "daily")));
    }
  }
  EXPECT_EQ(stored, values);
  for (const replay::Recording& recording : replay::read_study(folder, {}, "", 4).recordings)
    played[recording.id] = values_in(recording.config);
  EXPECT_EQ(played, values);
  EXPECT_THAT(contents(folder / "report.html"), HasSubstr("<dt>tidies up</dt><dd>daily, never</dd>"));
  EXPECT_THAT(contents(folder / "manifest.json"), HasSubstr("\"tidy-up\": \"never,daily\""));

  const StudyView view = view_of(planned({"--tidy-up", "never,daily"}));
  const auto all = evenly_spread(view.runs.size(), view.runs.size());
  EXPECT_THAT(html(run_table(view, Extent::all, all)), HasSubstr("tidies up"));
  EXPECT_EQ(group(view).variants, (std::vector<std::string>{"tidy daily", "tidy never"}));
  EXPECT_THAT(tex_names(view, all)[0], HasSubstr("TidyDaily"));
}

TEST(RunOptions, OneEntryIsAllThatAnOptionOfAWholeStudyNeeds) {
  const Plan before = planned({});
  const AddedRunOption added(swept()), second(most_brooms());
  const std::string help = help_of_short_study();
  EXPECT_THAT(help, HasSubstr("--swept-before"));
  EXPECT_THAT(help, HasSubstr("--most-brooms N"));
  EXPECT_EQ(planned({}).identity, before.identity);
  EXPECT_NE(planned({"--swept-before"}).identity, before.identity);
  EXPECT_NE(planned({"--most-brooms", "3"}).identity, before.identity);
  EXPECT_NE(planned({"--most-brooms", "3"}).identity, planned({"--most-brooms", "4"}).identity);

  const TemporaryFolder temporary;
  const std::string file = (temporary.path() / "study.toml").string();
  std::ofstream(file) << "[defaults]\nswept_before = true\n[study.one]\ndt = 0.01\n";
  EXPECT_EQ(planned({"--study", file.c_str()}).identity, planned({"--swept-before"}).identity);
  EXPECT_THAT(fault_of({"--grid", "swept_before=1"}), HasSubstr("no such axis"));
  EXPECT_THAT(fault_of({"--where", "most_brooms > 1"}), HasSubstr("most_brooms"));

  const std::filesystem::path folder = temporary.path() / "results";
  const std::string out = folder.string();
  carried_out({"--swept-before", "--most-brooms", "3", "--out", out.c_str()});
  const auto configs = stored_configs(folder);
  ASSERT_EQ(configs.size(), 1u);
  const RunConfig& config = configs.begin()->second;
  EXPECT_EQ(run_option("swept-before").value(config), OptionValue(std::int64_t{1}));
  EXPECT_EQ(run_option("most-brooms").value(config), OptionValue(std::int64_t{3}));
  EXPECT_THAT(identity_parts(config), Contains(Pair("swept_before", "on")));
  EXPECT_THAT(identity_parts(config), Contains(Pair("most_brooms", "3")));
  EXPECT_THAT(contents(folder / "manifest.json"), HasSubstr("\"most_brooms\": 3"));
  EXPECT_THAT(contents(folder / "manifest.json"), HasSubstr("\"swept_before\": true"));
  EXPECT_THAT(contents(folder / "runs.csv"), Not(HasSubstr("swept_before")));
}

// Stored studies have ids of this text.
TEST(RunOptions, OptionsOfAWholeStudyEndTheIdentity) {
  RunConfig config;
  config.integrator = "cvode_adams";
  config.tolerance = 1e-6;
  const std::string before = identity_of(config);
  config.max_steps = 7;
  EXPECT_EQ(identity_of(config), before + "\nmax_steps 7");
  config.reference = true;
  config.settings["order"] = 3;
  EXPECT_THAT(identity_of(config), EndsWith("\norder 3\nmax_steps 7\nreference"));
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

TEST(RunOptions, RunsWithAnotherValueOfAnOptionHaveOtherOptionsAndCells) {
  const NamedOptions named = options_on_demand();
  ConfigCells cells(named);
  const auto expect_cells = [&](const RunConfig& config) { EXPECT_EQ(cells.of(config), config_cells(config, named)); };
  RunConfig usual;
  usual.integrator = "rk4";
  usual.contact.emplace();
  usual.joints.emplace();
  for (const RunOption& option : run_options()) {
    RunConfig other = usual;
    OptionValue value = std::string("another");
    if (option.known) {
      for (const std::string& known : option.known()) {
        if (OptionValue(known) != option.value(usual)) value = known;
      }
    } else if (option.kind == RunOption::Kind::number) {
      value = 0.7;
    } else if (option.kind != RunOption::Kind::name) {
      value = std::int64_t{1};
    }
    option.set(other, value);
    EXPECT_FALSE(have_same_options(usual, other)) << option.name;
    expect_cells(usual);
    expect_cells(other);
    other.varied = {{"body.0.mass", "2"}, {"gravity.2", ""}};
    expect_cells(other);
    RunConfig varied = other;
    varied.varied[0].value = "3";
    EXPECT_TRUE(have_same_options(other, varied));
    expect_cells(varied);
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
