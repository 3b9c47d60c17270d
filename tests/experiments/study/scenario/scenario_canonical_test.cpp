// SPDX-License-Identifier: BSD-3-Clause
// The canonical text of a scenario: it says all that decides a run, and nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/forces/catalogue.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::scenario_canonical_test {
namespace {

TEST(ScenarioCanonical, SaysNothingOfNamesTitlesAndSpelling) {
  const std::string canonical = resolved(base).canonical();
  EXPECT_EQ(ScenarioSource::parse(base, "elsewhere/other.toml").resolve().canonical(), canonical);
  for (const auto& [from, to] : std::map<std::string, std::string>{
           {"title = \"Test\"", "title = \"Other\"\ndescription = \"Text\""},
           {"t_end = 10.0", "t_end = 20"},
           {"name = \"ground\"", "name = \"floor\""},
           {"mass = 2.0", "mass = 2 # kg\nrestitution = 0.5\nfriction = 0.3"},
           {"inertia = [1.0, 2.0, 2.5]", "inertia = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]]"},
           {"inertia = [1.0, 2.0, 2.5]", "inertia = [1.0, 2.0, 2.5]\nvelocity = [0, 0, 0]\npinned = false"},
           {"stiffness = 40.0", "stiffness = 4e1\nrest_length = 0.0"}}) {
    EXPECT_EQ(resolved(changed(from, to)).canonical(), canonical) << to;
  }
  EXPECT_EQ(canonical.find("box"), std::string::npos);
}

TEST(ScenarioCanonical, OfAKnownScenario) {
  const std::string text = R"(t_end = 1
invariants = ["casimir"]
[[body]]
name = "ground"
static = true
[[body]]
name = "top"
mass = 1
inertia = [1, 2, 3]
velocity = [0, 1, 0]
angular_velocity = [0.3, 1, -0.5]
[[force]]
kind = "spring"
bodies = ["top", "ground"]
stiffness = 1e-30
)";
  EXPECT_EQ(resolved(text).canonical(),
            "body mass=1 static=false position=0,0,0 orientation=1,0,0,0 inertia=1,0,0,0,2,0,0,0,3 pinned=false "
            "center_of_mass=0,0,0 velocity=0,1,0 angular_velocity=0.3,1,-0.5 frame=world\n"
            "body mass=1 static=true position=0,0,0 orientation=1,0,0,0\n"
            "spring bodies=0,1 anchor_body=0,0,0 anchor_body_2=0,0,0 anchor_world=0,0,0 damping=0 rest_length=0 "
            "stiffness=1e-30\n"
            "invariant casimir\n")
      << "a change here makes every stored run anew: is that meant?";
}

TEST(ScenarioCanonical, NumbersReadBackExactly) {
  const double mass = 0.1 + 0.2;
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", mass);
  EXPECT_THAT(resolved(base, {{"body.0.mass", digits}}).canonical(), HasSubstr("mass=0.30000000000000004 "));
}

/// A value for each key of a body that makes another run; a key that is missing here fails the test.
TEST(ScenarioCanonical, SeesEveryKeyOfABody) {
  const std::map<std::string_view, Override> other = {
      {"mass", {"body.0.mass", "3"}},
      {"shape", {"body.2.shape", "{ kind = \"sphere\", radius = 0.2 }"}},
      {"inertia", {"body.0.inertia", "[1, 2, 2.25]"}},
      {"position", {"body.0.position", "[1, 0, 0]"}},
      {"orientation", {"body.0.orientation", "[-1, 0, 0, 0]"}},
      {"velocity", {"body.0.velocity", "[1, 0, 0]"}},
      {"angular_velocity", {"body.0.angular_velocity", "[1, 0, 0]"}},
      {"angular_velocity_frame", {"body.0.angular_velocity_frame", "\"body\""}},
      {"pinned", {"body.0.pinned", "true"}},
      {"center_of_mass", {"body.1.center_of_mass", "[1, 0, 0]"}},
      {"static", {"body.1.static", "true"}},
      {"repeat", {"body.1.repeat", "[1, 1, 2]"}},
      {"spacing", {"body.1.spacing", "[0, 2, 0]"}},
      {"jitter", {"body.1.jitter", "0.1"}},
      {"jitter_angle", {"body.1.jitter_angle", "0.1"}}};
  const std::string text = changed("name = \"ground\"\nstatic = true", R"(name = "hung"
mass = 1
inertia = [2, 2, 2]
pinned = true)");
  const std::string canonical = resolved(text).canonical();
  for (const ScenarioKey& key : body_keys()) {
    // These two allow or replace what other keys say.
    if (key.decides != Decides::always || key.name == "unphysical_inertia" || key.name == "point_masses") continue;
    ASSERT_TRUE(other.contains(key.name)) << key.name;
    std::vector<Override> overrides = {other.at(key.name)};
    std::vector<Override> beside;
    if (key.name == "static") overrides.push_back({"body.1.pinned", "false"});
    if (key.name == "repeat") overrides.push_back({"body.1.spacing", "[0, 0, 1]"});
    if (key.name == "spacing" || key.name.starts_with("jitter")) {
      beside = {{"body.1.repeat", "[1, 2, 1]"}, {"body.1.spacing", "[0, 1, 0]"}};
      overrides.insert(overrides.begin(), beside.begin(), beside.end());
    }
    EXPECT_NE(resolved(text, overrides).canonical(), beside.empty() ? canonical : resolved(text, beside).canonical())
        << key.name;
  }
  EXPECT_NE(resolved(text, {{"gravity", "[0, 0, 1]"}}).canonical(), canonical);
  EXPECT_NE(resolved(text, {{"gravity", "[0, 0, 0]"}}).canonical(), canonical);
}

TEST(ScenarioCanonical, SeesEveryKeyOfAForce) {
  for (const ForceEntry& entry : force_catalogue()) {
    const ForceKind& kind = entry.kind;
    for (const int bodies : {1, 2}) {
      if (bodies < kind.min_bodies || (kind.max_bodies != 0 && bodies > kind.max_bodies)) continue;
      std::string text =
          "t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 1, 1]\n[[body]]\nmass = 1\ninertia = [1, 1, 1]\n";
      text += "[[force]]\nkind = \"" + kind.name + "\"\nbodies = [\"body0\"" + (bodies == 2 ? ", \"body1\"]\n" : "]\n");
      for (const Parameter& p : kind.parameters) {
        if (p.need != Parameter::Need::required && !std::holds_alternative<double>(p.value)) continue;
        text += p.key + (std::holds_alternative<double>(p.value) ? " = 0.5\n" : " = [0.5, 0.5, 0.5]\n");
      }
      const std::string canonical = resolved(text).canonical();
      EXPECT_NE(
          resolved(text, {{"force.0.bodies", bodies == 2 ? "[\"body1\", \"body0\"]" : "[\"body1\"]"}}).canonical(),
          canonical);
      for (const Parameter& p : kind.parameters) {
        if (p.needs_bodies != 0 && p.needs_bodies != bodies) continue;
        const std::string value = std::holds_alternative<double>(p.value)   ? "0.25"
                                  : std::holds_alternative<Vector>(p.value) ? "[1, 2, 3]"
                                                                            : '"' + p.choices.back() + '"';
        EXPECT_NE(resolved(text, {{"force.0." + p.key, value}}).canonical(), canonical) << kind.name << "." << p.key;
      }
    }
  }
}

TEST(ScenarioCanonical, SeesTheInvariants) {
  const std::string text = "t_end = 1\n[[body]]\nmass = 1\ninertia = [2, 2, 1]\n";
  const auto with = [&](const char* list) { return resolved(text, {{"invariants", list}}).canonical(); };
  EXPECT_NE(with("[\"casimir\"]"), with("[]"));
  EXPECT_EQ(with("[\"casimir\", \"p_psi\"]"), with("[\"p_psi\", \"casimir\"]"));
}

}  // namespace
}  // namespace polhode::study::scenario_tests::scenario_canonical_test
