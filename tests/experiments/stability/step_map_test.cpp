// SPDX-License-Identifier: BSD-3-Clause
// Linear theory on the oscillator: the spectral radius of a step.
#include "experiments/stability/step_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::stability::step_map_test {
namespace {

Scenario oscillator(const std::vector<Override>& overrides = {}) {
  return ScenarioSource::open("oscillator").resolve(overrides);
}

double radius(const char* method, double dt, const Scenario& scenario, const Formulation& formulation = {}) {
  return spectral_radius(*find_integrator(method), scenario.problem, formulation, dt).value();
}

TEST(StepMap, HasTheRadiusOfLinearTheory) {
  const Scenario scenario = oscillator();
  for (const double h : {1e-3, 0.1, 0.7, 1.9, 2.5, 10.0}) {
    const double y2 = h * h, rk4 = std::hypot(1 - y2 / 2 + y2 * y2 / 24, h * (1 - y2 / 6));
    const double verlet = h <= 2 ? 1 : y2 / 2 - 1 + std::sqrt((y2 / 2 - 1) * (y2 / 2 - 1) - 1);
    for (const Orientation chart : {Orientation::quaternion, Orientation::matrix}) {
      const Formulation f{.orientation = chart};
      EXPECT_NEAR(radius("explicit_euler", h, scenario, f), std::sqrt(1 + y2), 1e-13 * (1 + h)) << h;
      EXPECT_NEAR(radius("rk4", h, scenario, f) / rk4, 1, 1e-12) << h;
      EXPECT_NEAR(radius("velocity_verlet", h, scenario, f) / verlet, 1, 1e-12) << h;
      EXPECT_NEAR(radius("semi_implicit_euler", h, scenario, f) / verlet, 1, 1e-12) << h;
    }
  }
}

TEST(StepMap, OfTheExplicitEulerMethodIsAboveOneAtEveryStepAndOfTheImplicitMidpointRuleAtNone) {
  const Scenario scenario = oscillator();
  for (double h = 1e-5; h <= 100; h *= 1.7) {
    EXPECT_GT(radius("explicit_euler", h, scenario) - 1, 0.4 * h * h / (1 + h)) << h;
    EXPECT_NEAR(radius("implicit_midpoint", h, scenario), 1, 1e-9) << h;
  }
  EXPECT_NEAR(radius("implicit_midpoint", 100, scenario), 1, 1e-9);
}

TEST(StepMap, ScalesWithTheStiffness) {
  const Scenario stiff = oscillator({{"force.0.stiffness", "1e6"}, {"body.0.mass", "4"}});
  EXPECT_NEAR(radius("velocity_verlet", 1.999 / 500, stiff), 1, 1e-9);
  EXPECT_GT(radius("velocity_verlet", 2.001 / 500, stiff), 1.01);
}

TEST(StepMap, IsNotThereWithoutALinearSystemOrAMapOfOneStep) {
  const auto none = [](const char* method, const char* scenario) {
    return !spectral_radius(*find_integrator(method), ScenarioSource::open(scenario).resolve().problem, {}, 0.01);
  };
  for (const char* scenario : {"coursework", "spring_box", "hairer_vilmart", "physical_pendulum", "two_bodies"}) {
    EXPECT_TRUE(none("rk4", scenario)) << scenario;
  }
  EXPECT_TRUE(none("odeint_adams_bashforth_moulton", "oscillator"));
  EXPECT_TRUE(none("cvode_bdf", "oscillator"));
  EXPECT_FALSE(none("rk4", "oscillator"));
}

}  // namespace
}  // namespace polhode::study::stability::step_map_test
