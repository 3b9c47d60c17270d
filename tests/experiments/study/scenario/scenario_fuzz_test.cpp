// SPDX-License-Identifier: BSD-3-Clause
// Mutated scenarios: whatever bytes, lines or numbers are changed, the reader gives a scenario that can be simulated,
// or one line that says what is wrong. The mutations are the same at every run.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/problem/inertia.hpp"
#include "core/system/system.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::scenario_fuzz_test {
namespace {

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers with every standard library.
class FuzzRandom {
 public:
  explicit FuzzRandom(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>((z ^ (z >> 31)) % n);
  }
  template <class List>
  const auto& of(const List& list) {
    return list[below(list.size())];
  }

 private:
  std::uint64_t state_;
};

const std::vector<std::string> numbers = {"0",     "-1",     "1e308", "-1e308", "1e-310", "5e-324", "nan",
                                          "inf",   "-inf",   "0x7f",  "1e999",  "9e18",   "1_000",  "-0.0",
                                          "1e200", "0.1",    "[]",    "{}",     "true",   "\"\"",   "[1, 2]",
                                          "''",    "1e-200", "07",    "1.e3",   "3"};
const std::vector<std::string> snippets = {"[[body]]", "[[force]]", "[body]", "mass",   "inertia",  "\n",  "\"",
                                           "\"\"\"",   "#",         "=",      ".",      "{",        "}",   "[",
                                           "]",        ",",         "static", "pinned", "true",     "\\u", "\xc3\xa4",
                                           "\xff",     "shape",     "bodies", "name",   "position", "\r",  "velocity"};
const std::vector<std::string> keys = {"gravity",           "gravity.2",     "t_end",
                                       "body.0.mass",       "body.0.pinned", "body.0.inertia.0",
                                       "body.0.inertia",    "body.0.static", "body.0.angular_velocity.1",
                                       "body.1.mass",       "body.0.shape",  "body.0.orientation",
                                       "force.0.stiffness", "force.0.kind",  "body.0.position.0",
                                       "body.box.velocity", "invariants",    "body.0.unphysical_inertia"};
const std::vector<std::string> inserted_lines = {"static = true",
                                                 "pinned = true",
                                                 "gravity = [1, 2, 3]",
                                                 "invariants = [\"p_phi\", \"p_psi\"]",
                                                 "shape = { kind = \"capsule\", radius = 1, length = 2 }",
                                                 "point_masses = [{ mass = 1, position = [0, 0, 0] }]",
                                                 "unphysical_inertia = true",
                                                 "inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                                                 "center_of_mass = [0, 0, 1]",
                                                 "[[force]]\nkind = \"drag\"\nbodies = [\"box\"]\nlinear = 1",
                                                 "[[body]]\nmass = 1\ninertia = [1, 1, 1]"};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> all(1);
  for (const char c : text) {
    all.back() += c;
    if (c == '\n') all.emplace_back();
  }
  return all;
}

std::string joined(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& line : all) text += line;
  return text;
}

void mutate_bytes(std::string& text, FuzzRandom& dice) {
  const std::size_t at = dice.below(text.size() + 1);
  switch (dice.below(4)) {
    case 0: text.insert(at, dice.of(snippets)); break;
    case 1: text.insert(at, 1, static_cast<char>(dice.below(256))); break;
    case 2: text.erase(at, 1 + dice.below(8)); break;
    default:
      if (at < text.size()) text[at] = static_cast<char>(dice.below(256));
  }
}

void mutate_lines(std::string& text, FuzzRandom& dice) {
  std::vector<std::string> all = split(text);
  const auto at = [&] { return all.begin() + static_cast<std::ptrdiff_t>(dice.below(all.size())); };
  switch (dice.below(4)) {
    case 0: all.erase(at()); break;
    case 1: std::swap(*at(), *at()); break;
    case 2: {
      const std::string line = dice.of(all);
      all.insert(at(), line);
      break;
    }
    default: all.insert(at(), dice.of(inserted_lines) + '\n');
  }
  text = joined(all);
}

/// Another value for one of the numbers that stand after an equals sign.
void mutate_number(std::string& text, FuzzRandom& dice) {
  const std::size_t start = dice.below(text.size() + 1);
  for (std::size_t i = start; i < text.size(); ++i) {
    const bool begins =
        std::isdigit(static_cast<unsigned char>(text[i])) && i > 0 && (text[i - 1] == ' ' || text[i - 1] == '[');
    if (!begins) continue;
    const std::size_t end = text.find_first_not_of("0123456789.e-+", i);
    text.replace(i, (end == std::string::npos ? text.size() : end) - i, dice.of(numbers));
    return;
  }
}

/// Expects what every scenario that was let through must meet; a step of its equations must not crash.
void expect_sound(const Scenario& s) {
  ASSERT_GT(s.t_end, 0);
  ASSERT_TRUE(std::isfinite(s.t_end));
  ASSERT_EQ(s.problem.bodies.size(), s.problem.starts.size());
  ASSERT_GE(s.problem.moving(), 1u);
  for (std::size_t i = 0; i < s.problem.bodies.size(); ++i) {
    const Body& b = s.problem.bodies[i];
    const BodyStart& start = s.problem.starts[i];
    ASSERT_TRUE(b.mass > 0 && std::isfinite(b.mass));
    ASSERT_EQ(equations_inertia_fault(b.inertia), "");
    ASSERT_NEAR(start.orientation.norm(), 1, 1.1e-6);
    ASSERT_TRUE(start.position.allFinite() && start.velocity.allFinite() && start.angular_velocity.allFinite());
    ASSERT_EQ(b.fixed, i >= s.problem.moving());
  }
  for (const ForceParameters& f : s.problem.forces) {
    for (const std::size_t body : f.bodies) ASSERT_LT(body, s.problem.bodies.size());
  }
  const auto system = make_system<double>(s.problem, {});
  const State<double> state = system->start();
  VectorX<double> rate = state.y;
  system->rate(0, state.y.data(), rate.data());
  ASSERT_FALSE(s.canonical().empty());
}

/// Returns 1 if it was read, 0 if it was refused in the way it must be.
int read(const std::string& text, const std::vector<Override>& overrides, const std::string& begins) {
  try {
    expect_sound(ScenarioSource::parse(text, "fuzz.toml").resolve(overrides));
    return 1;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(begins, 0), 0u) << what;
    EXPECT_EQ(what.find_first_of("\n\r"), std::string::npos) << what;
    EXPECT_GT(what.size(), begins.size() + 10) << what;
    return 0;
  }
}

TEST(ScenarioFuzz, MutatedTextsAreReadOrRefused) {
  constexpr int rounds = 1500;
  int read_well = 0, all = 0;
  for (const BuiltinScenario& builtin : builtin_scenarios()) {
    FuzzRandom dice(static_cast<std::uint64_t>(all) + 1);
    if (builtin.name == "pile_100" || builtin.name == "pile_1000") continue;  // the text of pile_10, and slow to build
    for (int i = 0; i < rounds && !testing::Test::HasFailure(); ++i, ++all) {
      std::string text(builtin.text);
      const std::size_t mutations = 1 + dice.below(3);
      for (std::size_t m = 0; m < mutations; ++m) {
        switch (dice.below(3)) {
          case 0: mutate_bytes(text, dice); break;
          case 1: mutate_lines(text, dice); break;
          default: mutate_number(text, dice);
        }
      }
      SCOPED_TRACE(text);
      read_well += read(text, {}, "fuzz.toml:");
    }
  }
  // Both happen often, or the mutations test nothing.
  EXPECT_GT(read_well, all / 10);
  EXPECT_LT(read_well, 9 * all / 10);
}

/// Keys of 10⁵ parts and as many brackets anywhere, which overflow the stack of whoever follows them down.
TEST(ScenarioFuzz, EndlessNestingIsRefused) {
  const std::vector<std::string> openings = {"a.", "a . ", "\"a\".", "'='.",    "\",\".", "[",
                                             "[[", "{a=",  "[{a.b=", "a = [\n", "x={"};
  FuzzRandom dice(11);
  for (int i = 0; i < 30 && !testing::Test::HasFailure(); ++i) {
    std::vector<std::string> text = split(std::string(builtin_scenarios()[dice.below(8)].text));
    const std::string& opening = dice.of(openings);
    std::string deep;
    for (int k = 0; k < 100'000; ++k) deep += opening;
    const std::size_t at = dice.below(text.size());
    text.insert(text.begin() + static_cast<std::ptrdiff_t>(at), (dice.below(2) == 0 ? "[" : "") + deep + "a = 1\n");
    SCOPED_TRACE(opening);
    EXPECT_EQ(read(joined(text), {}, "fuzz.toml:"), 0);
    EXPECT_EQ(read(joined(text).substr(0, joined(text).size() / 2), {}, "fuzz.toml:"), 0);
    const std::string scenario(builtin_scenarios()[0].text);
    EXPECT_EQ(read(scenario, {{"body.0.mass", deep + "1"}}, "--vary "), 0);
    EXPECT_EQ(read(scenario, {{deep + "mass", "1"}}, "--vary "), 0);
  }
}

TEST(ScenarioFuzz, RandomOverridesAreReadOrRefused) {
  const std::vector<std::string> parts = {"body",        "force", "gravity", "0",        "1",         "2",
                                          "box",         "mass",  "inertia", "shape",    "radius",    "position",
                                          "kind",        "t_end", "",        "static",   "stiffness", "bodies",
                                          "orientation", "x",     "pinned",  "velocity", "-1",        "\n"};
  FuzzRandom dice(7);
  int read_well = 0;
  for (int i = 0; i < 6000 && !testing::Test::HasFailure(); ++i) {
    const std::string text(dice.of(builtin_scenarios()).text);
    std::vector<Override> overrides;
    do {
      std::string key = dice.of(dice.below(2) == 0 ? keys : parts);
      for (std::size_t n = dice.below(2) * dice.below(4); n > 0; --n) key += "." + dice.of(parts);
      overrides.push_back({key, dice.below(8) == 0 ? dice.of(snippets) : dice.of(numbers)});
    } while (dice.below(4) == 0);
    SCOPED_TRACE(overrides[0].key + "=" + overrides[0].value);
    read_well += read(text, overrides, "--vary ");
  }
  EXPECT_GT(read_well, 100);
}

}  // namespace
}  // namespace polhode::study::scenario_fuzz_test
