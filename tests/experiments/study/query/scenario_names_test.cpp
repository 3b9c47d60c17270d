// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/scenario_names.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/store/store.hpp"
#include "tests/experiments/study/query/stored_studies.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::query_tests::scenario_names_test {
namespace {

/// Keeps the scenario top.toml with this text in a store; `added`: what its canonical text has besides.
void keep_top(const std::filesystem::path& folder, const std::string& text, const std::string& added = "") {
  std::filesystem::create_directories(folder);
  Scenario scenario = ScenarioSource::parse(text, "top.toml").resolve();
  scenario.contact_text += added;
  Store(folder).keep_scenarios({&scenario, 1});
}

TEST(ScenarioNames, HaveAFolderWhereScenariosOfOneNameDiffer) {
  const TemporaryFolder folder;
  const auto in = [&](const std::string& name) { return (folder.path() / name).string(); };
  keep_top(in("a"), top);
  keep_top(in("b"), std::string(top) + "position = [1, 0, 0]\n");
  keep_top(in("c"), top);
  const ResultStores stores({in("a"), in("b"), in("c")}), same({in("a"), in("c")});
  const ScenarioNames names(stores);
  EXPECT_TRUE(names.ambiguous());
  EXPECT_EQ(names.of("top", *stores.all()[0]), "top (" + in("a") + ")");
  EXPECT_EQ(names.of("top", *stores.all()[1]), "top (" + in("b") + ")");
  EXPECT_EQ(names.of("top", *stores.all()[2]), "top (" + in("a") + ")");
  EXPECT_EQ(names.of("other", *stores.all()[0]), "other");
  EXPECT_FALSE(ScenarioNames(same).ambiguous());
  EXPECT_EQ(ScenarioNames(same).of("top", *same.all()[0]), "top");
}

TEST(ScenarioNames, StayWhereAnotherVersionWroteTheCanonicalTextOfOneScenario) {
  const TemporaryFolder folder;
  keep_top(folder.path() / "a", top);
  keep_top(folder.path() / "b", top, "a line of another version\n");
  const ResultStores stores({(folder.path() / "a").string(), (folder.path() / "b").string()});
  ASSERT_NE(stores.all()[0]->scenarios.at("top").canonical, stores.all()[1]->scenarios.at("top").canonical);
  EXPECT_FALSE(ScenarioNames(stores).ambiguous());
}

}  // namespace
}  // namespace polhode::study::query_tests::scenario_names_test
