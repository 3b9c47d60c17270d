// SPDX-License-Identifier: BSD-3-Clause
// The built-in scenarios: documented, with units, and with the numbers of their sources.
#include "experiments/study/scenario/builtin_scenarios.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "core/system/system.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::builtin_scenarios_test {
namespace {

Scenario builtin(const char* name) { return ScenarioSource::open(name).resolve(); }

double initial_energy(const Scenario& s) {
  const auto system = make_system<double>(s.problem, {});
  const Measurement<double> m = system->measure(system->start().y);
  return m.kinetic + m.potential;
}

TEST(BuiltinScenarios, AllResolveAndAreDocumented) {
  EXPECT_GE(builtin_scenarios().size(), 17u);
  for (const BuiltinScenario& b : builtin_scenarios()) {
    const Scenario s = builtin(std::string(b.name).c_str());
    EXPECT_EQ(s.name, b.name);
    EXPECT_FALSE(s.title.empty()) << b.name;
    EXPECT_FALSE(s.description.empty()) << b.name;
    EXPECT_TRUE(std::isfinite(initial_energy(s))) << b.name;
    EXPECT_THAT(std::string(b.text), HasSubstr("\n# ")) << b.name << " must open with its physics";
  }
}

TEST(BuiltinScenarios, NumbersCarryUnits) {
  for (const BuiltinScenario& b : builtin_scenarios()) {
    std::istringstream lines{std::string(b.text)};
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find(" = ");
      const bool number =
          equals != std::string::npos && std::string("0123456789-[{").find(line[equals + 3]) != std::string::npos;
      if (number && line.find("[\"") == std::string::npos && line[0] != '#') {
        EXPECT_NE(line.find("# "), std::string::npos) << b.name << ": " << line;
      }
    }
  }
}

TEST(BuiltinScenarios, ReferenceNumbers) {
  EXPECT_NEAR(initial_energy(builtin("peters_hsu")), 368.546416625, 1e-9);
  EXPECT_NEAR(initial_energy(builtin("simo_wong")), 1269.975005208, 1e-9);
  EXPECT_NEAR(initial_energy(builtin("oscillator")), 0.5, 1e-15);
  const auto momentum_body = [](const char* name) {
    const Scenario s = builtin(name);
    EXPECT_TRUE(s.problem.starts[0].angular_velocity_in_body) << name;
    return Vector(s.problem.bodies[0].inertia * s.problem.starts[0].angular_velocity);
  };
  EXPECT_LE((momentum_body("dzhanibekov") - Vector(0, 2, 0.01)).norm(), 1e-17);
  EXPECT_LE((momentum_body("hairer_vilmart") - Vector(1.8, 0.4, -0.9)).norm(), 1e-15);
  EXPECT_LE((momentum_body("detest_b5") - Vector(0, 3 * std::sqrt(0.51), std::sqrt(3.0))).norm(), 1e-15);
  for (const Body& cube : builtin("five_cubes").problem.bodies) EXPECT_NEAR(cube.inertia(2, 2), 1 / 6.0, 1e-16);
  // I = m w²/12 + m l²/12 + m l²/4
  EXPECT_NEAR(builtin("physical_pendulum").problem.bodies[0].inertia(0, 0), 0.0004 / 12 + 1 / 3.0, 1e-15);
}

TEST(BuiltinScenarios, TwoBodiesAreOnTheirEllipse) {
  const Problem p = builtin("two_bodies").problem;
  const double r = (p.starts[1].position - p.starts[0].position).norm();
  const double v = (p.starts[1].velocity - p.starts[0].velocity).norm();
  EXPECT_NEAR(1 / (2 / r - v * v / 2), 1, 1e-14) << "the semi-major axis, with G (m1 + m2) = 2";
  EXPECT_NEAR(r, 1.5, 1e-15);
}

}  // namespace
}  // namespace polhode::study::scenario_tests::builtin_scenarios_test
