// SPDX-License-Identifier: BSD-3-Clause
// The extent of a motion, against closed forms.
#include "experiments/study/scenario/motion_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polhode::study::motion_size_test {
namespace {

double size_of(const char* scenario, double seconds) {
  return motion_size(ScenarioSource::open(scenario).resolve(), seconds);
}

TEST(MotionSize, IsHowFarAMassCentreGets) {
  // Thrown at 45° with 10 m/s each way: after 2 s at 20 m, 20 m − ½ g 4 s².
  EXPECT_NEAR(size_of("projectile", 2), std::hypot(20, 20 - 2 * 9.81), 1e-9);
  // Let go at 1 m: on the other side after half a period, one of the 64 instants.
  EXPECT_NEAR(size_of("oscillator", 62.83185307179586), 2, 0.02);
}

TEST(MotionSize, IsWithoutBoundWhereNothingMovesOrNoPathIsKnown) {
  EXPECT_TRUE(std::isinf(size_of("hairer_vilmart", 10)));
  EXPECT_TRUE(std::isinf(size_of("spring_box", 1)));
}

}  // namespace
}  // namespace polhode::study::motion_size_test
