// SPDX-License-Identifier: BSD-3-Clause
// A variant made from the scenario itself, with what the calls before have left, is what reading all of it gives.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::scenario_variant_test {
namespace {

/// All of the scenario that a varied key can change, or the error.
std::string text_of(const ScenarioSource& source, const std::vector<Override>& overrides, const Scenario* plain) {
  try {
    const Scenario scenario = source.resolve(overrides, plain);
    std::string text = scenario.name + "\n" + scenario.title + "\n" + scenario.description + "\n";
    text += std::to_string(scenario.t_end) + "\n" + std::to_string(scenario.end_at_contact) + "\n";
    text += std::to_string(scenario.energy_scale.value_or(0)) + "\n" + scenario.canonical();
    text += std::to_string(scenario.compliance.slip_speed) + " " + std::to_string(scenario.compliance.stiffness) + "\n";
    for (const Body& body : scenario.problem.bodies) text += body.name + "\n";
    for (const ShapePointer& shape : scenario.shapes) {
      text += shape ? std::string(shape->kind()) : "no shape";
      if (shape && shape->finite()) text += " " + std::to_string(shape->mass_properties().volume);
      text += "\n";
    }
    for (const std::string& name : scenario.invariants) text += name + "\n";
    for (const std::string& note : scenario.notes) text += note + "\n";
    return text + std::to_string(scenario.colliders.size()) + *scenario.source;
  } catch (const InputError& error) {
    return error.what();
  }
}

/// The same made in full, and in a tree of its own: the thread's is given to another scenario in between.
std::string made_in_full(const ScenarioSource& source, const std::vector<Override>& overrides) {
  static const ScenarioSource other = ScenarioSource::open("coursework");
  const std::vector<Override> any = {{"t_end", "7"}};
  other.resolve(any);
  return text_of(source, overrides, nullptr);
}

std::vector<std::string> keys_to_vary() {
  std::vector<std::string> keys = {"gravity.2",          "body.0.inertia.0", "body.0.angular_velocity.1",
                                   "body.0.position.0",  "body.1.mass",      "body.1.position",
                                   "body.1.velocity.2",  "force.0.kind",     "force.0.stiffness",
                                   "body.0.shape.radius"};
  for (const ScenarioKey& key : root_keys()) keys.emplace_back(key.name);
  for (const ScenarioKey& key : body_keys()) keys.push_back("body.0." + std::string(key.name));
  return keys;
}

TEST(ScenarioVariant, IsWhatReadingAllOfItGives) {
  const std::vector<std::string> keys = keys_to_vary();
  const std::vector<std::string> values = {"0.5", "-1", "[1, 0, 0, 0]", "[0.1, 0.2, 0.3]", "\"body\"", "true"};
  for (const BuiltinScenario& scenario : builtin_scenarios()) {
    const std::string name(scenario.name);
    const ScenarioSource source = ScenarioSource::open(name), again = ScenarioSource::open(name);
    const Scenario plain = source.resolve();
    const bool few = plain.problem.bodies.size() < 4 && plain.problem.joints.empty();
    std::vector<std::vector<Override>> all = {{}};
    for (std::size_t k = 0; k < keys.size(); k += few ? 1 : 5) {
      for (const std::string& value : values) {
        all.push_back({{keys[k], value}});
        all.push_back({{keys[k], value}, {keys[(k + 4) % keys.size()], "0.25"}});
      }
    }
    all.push_back({});
    std::vector<std::string> texts;  // made one after the other, so that each has what those before it left behind
    for (const auto& overrides : all) texts.push_back(text_of(source, overrides, &plain));
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(texts[k], made_in_full(again, all[k]))
          << name << (all[k].empty() ? "" : " " + all[k][0].key + " = " + all[k][0].value);
    }
  }
}

TEST(ScenarioVariant, OfOneScenarioLeavesTheOthersAlone) {
  const ScenarioSource top = ScenarioSource::open("free_symmetric_top"), work = ScenarioSource::open("oscillator");
  const std::vector<Override> spin = {{"body.0.angular_velocity.1", "0.5"}}, wrong = {{"body.0.mass", "-1"}};
  const std::string of_top = made_in_full(top, spin), of_work = made_in_full(work, spin);
  const std::string error = made_in_full(work, wrong);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(text_of(top, spin, nullptr), of_top);
    EXPECT_EQ(text_of(work, spin, nullptr), of_work);
    EXPECT_EQ(text_of(work, wrong, nullptr), error);
  }
}

}  // namespace
}  // namespace polhode::study::scenario_variant_test
