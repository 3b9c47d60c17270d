// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/explain/identity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "experiments/study/query/result_stores.hpp"
#include "tests/experiments/study/query/stored_studies.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::explain::identity_test {
namespace {

using query_tests::keep_in;
using query_tests::random_config;
using query_tests::run_of;
using query_tests::top;

/// A change of one key of a run.
struct Change {
  std::string key;  ///< key that explain must name
  std::function<void(RunConfig&, std::string& text)> make;
};

void replace(std::string& text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
}

std::vector<Change> changes() {
  return {
      {"dt_s", [](RunConfig& c, std::string&) { c.dt = *c.dt * 1.0000000001; }},
      {"t_end_s", [](RunConfig& c, std::string&) { c.t_end *= 2; }},
      {"samples", [](RunConfig& c, std::string&) { c.samples = c.samples.value_or(0) + 1; }},
      {"angular_state", [](RunConfig& c, std::string&) { c.formulation.angular_state = AngularState::momentum_world; }},
      {"gyroscopic", [](RunConfig& c, std::string&) { c.formulation.gyroscopic = !c.formulation.gyroscopic; }},
      {"normalize", [](RunConfig& c, std::string&) { c.normalize = !c.normalize; }},
      {"precision",
       [](RunConfig& c, std::string&) {
         c.precision =
             c.precision == Precision::double_precision ? Precision::single_precision : Precision::double_precision;
       }},
      {"summation",
       [](RunConfig& c, std::string&) { c.summation = is_compensated(c) ? Summation::plain : Summation::compensated; }},
      {"integrator", [](RunConfig& c, std::string&) { c.integrator = c.integrator == "rk4" ? "heun" : "rk4"; }},
      {"max_steps", [](RunConfig& c, std::string&) { c.max_steps = c.max_steps.value_or(7) + 1; }},
      {"reference", [](RunConfig& c, std::string&) { c.reference = !c.reference; }},
      {"scenario", [](RunConfig& c, std::string&) { c.scenario = "other_top"; }},
      {"gravity",
       [](RunConfig& c, std::string&) {
         c.varied.push_back({"gravity", "[0, 0, -1]"});
       }},
      {"body.0.inertia.1",
       [](RunConfig& c, std::string&) {
         c.varied.push_back({"body.0.inertia.1", "2.5"});
       }},
      {"gravity", [](RunConfig&, std::string& text) { replace(text, "-9.81", "-9.80665"); }},
      {"body.0.inertia", [](RunConfig&, std::string& text) { replace(text, "[1, 2, 3]", "[1, 2, 2.9]"); }},
      {"body.0.angular_velocity", [](RunConfig&, std::string& text) { replace(text, "0.1, 2", "0.1, 2.1"); }},
      {"body.0.angular_velocity_frame",
       [](RunConfig&, std::string& text) { text += "angular_velocity_frame = \"body\"\n"; }},
      {"body.0.position", [](RunConfig&, std::string& text) { text += "position = [1, 0, 0]\n"; }},
      {"body.0.orientation", [](RunConfig&, std::string& text) { text += "orientation = [0.6, 0.8, 0, 0]\n"; }},
  };
}

TEST(Identity, TheKeyThatDiffersIsNamedInEachOf20Cases) {
  std::mt19937_64 random(20);
  const TemporaryFolder folder;
  int trial = 0;
  for (const Change& change : changes()) {
    RunConfig config = random_config(random);
    while (!config.dt) config = random_config(random);
    std::string text = std::string(top) + "# a comment decides nothing\n";
    replace(text, "name = \"top\"", "name = \"top\" # or any other");
    RunConfig other = config;
    std::string other_text = top;
    change.make(other, other_text);
    const std::string name = "trial_" + std::to_string(trial++);
    const RunRecord a = run_of(text, config), b = run_of(other_text, other);
    ASSERT_NE(a.id, b.id) << change.key;
    const auto first = folder.path() / name / "a", second = folder.path() / name / "b";
    keep_in(first, text, a);
    keep_in(second, other_text, b);
    const ResultStores stores({first.string(), second.string()});
    const ExplainedRun one = explained(stores.find(a.id)), two = explained(stores.find(b.id));
    const std::vector<KeyDifference> found = differing_keys(one, two);
    ASSERT_EQ(found.size(), 1u) << change.key;
    EXPECT_EQ(found.front().key, change.key);
    EXPECT_NE(found.front().first, found.front().second);
    EXPECT_TRUE(differing_keys(one, one).empty());
  }
  EXPECT_GE(trial, 20);
}

TEST(Identity, AnOptionThatAppliesNoLongerIsNamedToo) {
  RunConfig config;
  config.scenario = "top";
  config.integrator = "rk4";
  config.dt = 0.1;
  const TemporaryFolder folder;
  const RunRecord a = run_of(top, config);
  config.formulation.orientation = Orientation::matrix;
  const RunRecord b = run_of(top, config);
  keep_in(folder.path(), top, a);
  keep_in(folder.path(), top, b);
  const ResultStores stores({folder.path().string()});
  const auto found = differing_keys(explained(stores.find(a.id)), explained(stores.find(b.id)));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].key, "orientation");
  EXPECT_EQ(found[1].key, "rotation_from");
  EXPECT_EQ(found[1].second, "");
}

TEST(Identity, OneRunHasTheKeysThatDecideIt) {
  RunConfig config;
  config.scenario = "top";
  config.integrator = "rk4";
  config.dt = 0.1;
  config.varied = {{"body.0.mass", "2"}};
  const TemporaryFolder folder;
  const RunRecord run = run_of(top, config);
  keep_in(folder.path(), top, run);
  const ResultStores stores({folder.path().string()});
  const auto keys = identity_of_run(explained(stores.find(run.id)));
  const auto value = [&](const std::string& key) {
    const auto at = std::find_if(keys.begin(), keys.end(), [&](const auto& pair) { return pair.first == key; });
    return at == keys.end() ? "missing" : at->second;
  };
  EXPECT_EQ(value("results version"), std::to_string(results_version));
  EXPECT_EQ(value("integrator"), "rk4");
  EXPECT_EQ(value("dt_s"), "0.1");
  EXPECT_EQ(value("body.0.mass"), "2");
  EXPECT_EQ(value("tolerance"), "missing");
}

}  // namespace
}  // namespace polhode::study::explain::identity_test
