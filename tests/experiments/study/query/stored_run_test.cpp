// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/stored_run.hpp"

#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/experiments/study/query/stored_studies.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::query_tests::stored_run_test {
namespace {

using testing::HasSubstr;

std::string reason(const ResultStores& stores, const std::string& id) {
  try {
    stores.find(id);
  } catch (const InputError& error) {
    return error.what();
  }
  return "found";
}

TEST(StoredRuns, ARunComesBackFromItsStoreWithItsId) {
  std::mt19937_64 random(11);
  const TemporaryFolder folder;
  std::map<std::string, RunConfig> kept;
  for (int k = 0; k < 200; ++k) {
    const RunConfig config = random_config(random);
    const RunRecord run = run_of(top, config);
    keep_in(folder.path(), top, run);
    kept.emplace(run.id, config);
  }
  const ResultStores stores({folder.path().string()});
  for (const auto& [id, config] : kept) {
    const FoundRun found = stores.find(id);
    const ReadRun read =
        read_run(*found.where->store.find(id, Curves::without), found.where->configurations, found.where->scenarios);
    EXPECT_EQ(read.version, results_version);
    EXPECT_EQ(configuration_of(read.config), configuration_of(config));
    EXPECT_EQ(read.config.varied, config.varied);
  }
}

TEST(StoredRuns, VariedKeysComeBackFromTheirText) {
  RunConfig config;
  config.varied = {{"a.b", "1"}, {"c", "\"two\nlines \\ and = signs\\n\""}, {"d", ""}, {"e", "[1, 2]"}};
  const auto varied = varied_of(varied_text(config));
  config.varied.erase(config.varied.begin() + 2);
  EXPECT_EQ(varied, config.varied);
  EXPECT_TRUE(varied_of("").empty());
  EXPECT_THROW(varied_of("no equals sign"), NotReproduced);
}

TEST(StoredRuns, WhatThisProgramDoesNotKnowIsNotReproduced) {
  EXPECT_THROW(config_of({{"colour", std::string("red")}}, ""), NotReproduced);
  EXPECT_THROW(config_of({{"orientation", std::string("spinor")}}, ""), NotReproduced);
  EXPECT_THROW(config_of({{"dt_s", std::string("small")}}, ""), NotReproduced);
  EXPECT_THROW(source_of({}, "top"), NotReproduced);
  EXPECT_THROW(source_of({{"top", {"canonical", ""}}}, "top"), NotReproduced);
}

TEST(StoredRuns, PartsOfTheIdentityAreEqualIfAndOnlyIfItIs) {
  std::mt19937_64 random(3);
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> known;
  for (int k = 0; k < 3000; ++k) {
    RunConfig config = random_config(random);
    config.dt = config.dt ? std::optional(0.1) : std::nullopt;  // few different ones, so that some are equal
    config.tolerance = config.tolerance ? std::optional(0.1) : std::nullopt;
    config.t_end = 1;
    if (config.samples) config.samples = 3;
    if (config.max_steps) config.max_steps = 3;
    if (!config.varied.empty()) config.varied.front().value = "7";
    std::string varied;  // the text of a scenario differs if other keys are set
    for (const Override& one : config.varied) varied += one.key + " ";
    const auto parts = identity_parts(config);
    const auto [at, is_new] = known.try_emplace(run_id(config, varied), parts);
    EXPECT_EQ(at->second, parts);
  }
  std::map<std::vector<std::pair<std::string, std::string>>, std::string> by_parts;
  for (const auto& [id, parts] : known) EXPECT_TRUE(by_parts.emplace(parts, id).second) << id;
  EXPECT_GT(known.size(), 100u);
  EXPECT_LT(known.size(), 2900u);
}

TEST(StoredRuns, AnIdMayBeCutShortIfNoOtherBeginsSo) {
  const TemporaryFolder folder;
  for (const char* id : {"8000000000000001", "8000000000000002", "7fffffffffffffff", "0000000000000000"}) {
    RunConfig config;
    config.scenario = "top";
    config.integrator = "rk4";
    RunRecord run = run_of(top, config);
    run.id = id;
    keep_in(folder.path() / "study", top, run);
  }
  const ResultStores stores({folder.path().string()});
  EXPECT_EQ(stores.find("7").id, "7fffffffffffffff");
  EXPECT_EQ(stores.find("0").id, "0000000000000000");
  EXPECT_EQ(stores.find("8000000000000002").id, "8000000000000002");
  EXPECT_THAT(reason(stores, "8"), HasSubstr("2 runs begin with 8: 8000000000000001 and 8000000000000002; add digits"));
  EXPECT_THAT(reason(stores, "9"), HasSubstr("no run 9… in"));
  EXPECT_THAT(reason(stores, ""), HasSubstr("is not the id of a run"));
  EXPECT_THAT(reason(stores, "80000000000000010"), HasSubstr("is not the id of a run"));
}

}  // namespace
}  // namespace polhode::study::query_tests::stored_run_test
