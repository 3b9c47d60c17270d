// SPDX-License-Identifier: BSD-3-Clause
// The largest rate of a scenario.
#include "experiments/study/scenario/characteristic_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::scenario_tests::characteristic_rate_test {
namespace {

TEST(CharacteristicRate, IsTheLargestOfAScenario) {
  const auto rate = [](const char* name, const std::vector<Override>& overrides = {}) {
    return characteristic_rate(ScenarioSource::open(name).resolve(overrides).problem);
  };
  EXPECT_DOUBLE_EQ(rate("oscillator").value(), 1);
  EXPECT_DOUBLE_EQ(rate("oscillator", {{"force.0.stiffness", "8"}, {"body.0.mass", "0.5"}}).value(), 4);
  EXPECT_NEAR(rate("hairer_vilmart").value(), std::sqrt(9 + 0.25 + 0.81), 1e-12);
  EXPECT_FALSE(rate("projectile", {{"body.0.angular_velocity", "[0, 0, 0]"}}));
  EXPECT_GT(rate("physical_pendulum").value(), 0);
  EXPECT_GT(rate("two_bodies").value(), 0);
}

}  // namespace
}  // namespace polhode::study::scenario_tests::characteristic_rate_test
