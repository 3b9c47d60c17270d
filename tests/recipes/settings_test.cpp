// SPDX-License-Identifier: BSD-3-Clause
// A setting that one method declares is an option of runs: the made-up method of two_stage.cpp stands in the catalogue
// of this program, and its settings are found on the command line, in the plan, in runs.csv, in the report and in the
// method.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/study/plan/listing.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/study.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "integrators/catalogue.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study {
namespace {

using ::testing::HasSubstr;

const Experiment settings_study = {
    .name = "settings_study",
    .question = "Does a setting of a method reach every place?",
    .defaults = {{"scenario", "peters_hsu"}, {"integrator", "two_stage"}, {"dt", "0.01"}}};

std::vector<const char*> call(std::initializer_list<const char*> more) {
  std::vector<const char*> all = {"settings_study", "--t-end", "0.5", "--no-figures"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Plan planned(std::initializer_list<const char*> more) {
  const auto words = call(more);
  return make_plan(settings_study, parse_options(settings_study, int(words.size()), words.data()).options);
}

std::string refused(std::initializer_list<const char*> more) {
  try {
    planned(more);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

RunConfig config_of(const std::string& method, const SettingValues& settings) {
  RunConfig config;
  config.scenario = "peters_hsu";
  config.integrator = method;
  config.dt = 0.01;
  config.t_end = 0.5;
  config.settings = settings;
  return config;
}

const Scenario& peters_hsu() {
  static const Scenario scenario = ScenarioSource::open("peters_hsu").resolve();
  return scenario;
}

double drift(const RunConfig& config) {
  EXPECT_EQ(refusal(config, peters_hsu()), "");
  const RunResult result = carry_out(config, peters_hsu(), {}, nullptr);
  EXPECT_EQ(result.status, "ok") << result.message;
  return *result.energy_drift_max;
}

TEST(MethodSettings, AreInTheHelpTheListAndStudyFiles) {
  testing::internal::CaptureStdout();
  const auto words = call({"--help"});
  EXPECT_EQ(parse_options(settings_study, int(words.size()), words.data()).exit_status, 0);
  const std::string help = testing::internal::GetCapturedStdout();
  EXPECT_THAT(help, HasSubstr("--node X"));
  EXPECT_THAT(help, HasSubstr("c of the second stage, as --list integrators says"));
  EXPECT_THAT(help, HasSubstr("--substep-count N"));
  EXPECT_THAT(help, HasSubstr("--weighting both|last"));
  EXPECT_THAT(help, HasSubstr("--order N"));
  EXPECT_THAT(listing("integrators", metric_table()),
              HasSubstr("the second at h/2, or --node 0.25 to 1, or --substep-count 1 to 8, or --weighting both, last "
                        "(made up, order 2, explicit)\n"));
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "study.toml").string();
  std::ofstream(file) << "node = [0.5, 1]\nsubstep_count = [1, 2, 4]\nweighting = \"last\"\n";
  EXPECT_EQ(planned({"--study", file.c_str()}).size(), 6u);
}

TEST(MethodSettings, MakeRunsOfTheirMethodAndLeaveOthersAlone) {
  const Plan plain = planned({"--integrator", "rk4,two_stage"});
  const Plan varied = planned({"--integrator", "rk4,two_stage", "--node", "0.5,1", "--substep-count", "2"});
  EXPECT_EQ(plain.size(), 2u);
  ASSERT_EQ(varied.size(), 3u);
  EXPECT_EQ(varied.run(0).id, plain.run(0).id) << "rk4 has no node";
  EXPECT_EQ(varied.run(0).config.settings, SettingValues{});
  EXPECT_EQ(varied.run(1).config.settings, (SettingValues{{"node", 0.5}, {"substep_count", 2}}));
  EXPECT_EQ(varied.run(2).config.settings, (SettingValues{{"node", 1.0}, {"substep_count", 2}}));
  EXPECT_EQ(std::set({plain.run(1).id, varied.run(1).id, varied.run(2).id}).size(), 3u);
  const auto columns = config_columns({}, varied.named), cells = config_cells(varied.run(1).config, varied.named);
  ASSERT_GE(columns.size(), 2u);
  EXPECT_EQ(std::vector(columns.end() - 2, columns.end()), (std::vector<std::string>{"node", "substep_count"}));
  EXPECT_EQ(std::vector(cells.end() - 2, cells.end()), (std::vector<std::string>{"0.5", "2"}));
}

TEST(MethodSettings, AreInTheStoreInTheTableOfRunsAndInTheReport) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "results";
  const std::string out = folder.string();
  testing::internal::CaptureStdout();
  const auto words =
      call({"--integrator", "two_stage,explicit_midpoint,heun", "--node", "0.5,1", "--out", out.c_str()});
  EXPECT_EQ(run_experiment(settings_study, int(words.size()), words.data()), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("node"));
  CsvReader table((folder / "runs.csv").string());
  const std::size_t id = table.column("run"), method = table.column("integrator"), node = table.column("node"),
                    energy = table.column("energy_drift_max_rel");
  std::vector<std::uint64_t> ids;
  std::map<std::string, double> drifts;
  while (table.next()) {
    ids.push_back(number_of_id(table.text(id)));
    drifts[table.text(method) + table.text(node)] = std::stod(table.text(energy));
  }
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(Store::ids_in(folder), ids);
  ASSERT_EQ(drifts.size(), 4u);
  // The value reaches the method, which then is one of the textbook's.
  EXPECT_NEAR(drifts.at("two_stage0.5") / drifts.at("explicit_midpoint"), 1, 1e-6);
  EXPECT_NEAR(drifts.at("two_stage1") / drifts.at("heun"), 1, 1e-6);
  EXPECT_GT(std::abs(drifts.at("two_stage1") / drifts.at("two_stage0.5") - 1), 1e-3);
  EXPECT_THAT(contents(folder / "report.html"), HasSubstr("<dt>node, c of the second stage</dt><dd>1, 0.5</dd>"));
}

TEST(MethodSettings, OfEveryTypeReachTheMethod) {
  const double usual = drift(config_of("two_stage", {}));
  EXPECT_EQ(drift(config_of("two_stage", {{"node", 0.5}, {"substep_count", 1}, {"weighting", "both"}})), usual);
  RunConfig halved = config_of("two_stage", {});
  halved.dt = 0.005;
  halved.samples = 50;
  RunConfig twice = config_of("two_stage", {{"substep_count", 2}});
  twice.samples = 50;
  EXPECT_NEAR(drift(twice) / drift(halved), 1, 1e-6);
  EXPECT_EQ(drift(config_of("two_stage", {{"weighting", "last"}})), usual) << "with c = 1/2 the first stage weighs 0";
  EXPECT_GT(drift(config_of("two_stage", {{"node", 1.0}, {"weighting", "last"}})), 10 * usual) << "order 1";
  for (const Precision precision : {Precision::single_precision, Precision::extended_precision}) {
    RunConfig heun = config_of("heun", {}), same = config_of("two_stage", {{"node", 1.0}});
    heun.precision = same.precision = precision;
    EXPECT_NEAR(drift(same) / drift(heun), 1, precision == Precision::single_precision ? 0.1 : 1e-6);
  }
  RunConfig heun = config_of("heun", {}), same = config_of("two_stage", {{"node", 1.0}});
  heun.summation = same.summation = Summation::compensated;
  EXPECT_NEAR(drift(same) / drift(heun), 1, 1e-6);
}

TEST(MethodSettings, UnknownKeysAndValuesOutOfRangeAreRefused) {
  const auto why = [](const std::string& method, const SettingValues& settings) {
    return refusal(config_of(method, settings), peters_hsu());
  };
  EXPECT_EQ(why("rk4", {{"node", 0.5}}), "rk4 takes no node; leave it out");
  EXPECT_EQ(why("two_stage", {{"order", 3}}), "two_stage takes no order; leave it out");
  EXPECT_EQ(why("two_stage", {{"node", 1.5}}), "two_stage has the nodes 0.25 to 1, not 1.5");
  EXPECT_EQ(why("two_stage", {{"node", std::nan("")}}), "two_stage has the nodes 0.25 to 1, not nan");
  EXPECT_EQ(why("two_stage", {{"node", "left"}}), "two_stage has the nodes 0.25 to 1, not left");
  EXPECT_EQ(why("two_stage", {{"substep_count", 9}}), "two_stage has the substep counts 1 to 8, not 9");
  EXPECT_EQ(why("two_stage", {{"weighting", "first"}}), "two_stage has the weightings both, last, not first");
  EXPECT_THAT(refused({"--node", "1.5"}), HasSubstr("two_stage has the nodes 0.25 to 1, not 1.5"));
  EXPECT_EQ(planned({"--node", "0.5,1.5"}).run(1).refusal, "two_stage has the nodes 0.25 to 1, not 1.5");
  EXPECT_THAT(refused({"--substep-count", "1.5"}), HasSubstr("--substep-count: 1.5 is not a substep count"));
  EXPECT_THAT(refused({"--weighting", "first"}), HasSubstr("--weighting: no 'first'"));
  EXPECT_THAT(refused({"--integrator", "rk4", "--node", "0.5"}),
              HasSubstr("--node: it has no effect, because no method here offers several nodes; leave it out, or name "
                        "one that does, such as two_stage"));
  const auto system = make_system<double>(peters_hsu().problem, {});
  EXPECT_THROW(find_integrator("two_stage")->make(*system, {.chosen = {{"node", 2.0}}}), std::invalid_argument);
}

}  // namespace
}  // namespace polhode::study
