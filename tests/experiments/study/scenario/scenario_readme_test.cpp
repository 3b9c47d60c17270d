// SPDX-License-Identifier: BSD-3-Clause
// The reference of scenarios in the README names every key, and its example can be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "collision/shapes/shape_catalogue.hpp"
#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::scenario_readme_test {
namespace {

std::string readme() {
  std::ifstream file(std::string(POLHODE_TESTS_DIR) + "/../experiments/scenarios/README.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The README's tables of keys are written by hand; this keeps them whole.
TEST(ScenarioReadme, NamesEveryKey) {
  const std::string text = readme();
  const auto expect_named = [&](std::string_view name) { EXPECT_THAT(text, HasSubstr('`' + std::string(name) + '`')); };
  for (const ScenarioKey& key : root_keys()) expect_named(key.name);
  for (const ScenarioKey& key : body_keys()) expect_named(key.name);
  for (const ForceEntry& entry : force_catalogue()) {
    expect_named(entry.kind.name);
    for (const Parameter& p : entry.kind.parameters) expect_named(p.key);
  }
  for (const JointEntry& entry : joint_catalogue()) {
    expect_named(entry.kind.name);
    for (const Parameter& p : entry.kind.parameters) expect_named(p.key);
  }
  for (const ShapeEntry& kind : shape_catalogue()) {
    expect_named(kind.name);
    for (const Parameter& p : kind.parameters) expect_named(p.key);
  }
  for (const InvariantKind& kind : invariant_catalogue()) expect_named(kind.name);
  for (const BuiltinScenario& b : builtin_scenarios()) expect_named(b.name);
}

TEST(ScenarioReadme, ItsExampleResolves) {
  const std::string text = readme(), fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  const Scenario s = resolved(text.substr(begin, text.find("```", begin) - begin));
  EXPECT_EQ(s.problem.bodies.size(), 1u);
}

}  // namespace
}  // namespace polhode::study::scenario_tests::scenario_readme_test
