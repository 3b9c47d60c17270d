// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/time_left.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace polhode::study::time_left_test {
namespace {

using UnderWay = TimeLeft::UnderWay;

TEST(TimeLeft, IsUnknownBeforeAnyWorkIsDone) {
  TimeLeft time;
  time.add("rk4", 100);
  EXPECT_FALSE(time.seconds({}, 1));
  EXPECT_FALSE(time.seconds(std::vector<UnderWay>{{"rk4", 100, 0, 5}}, 1));
  EXPECT_EQ(time.share({}), 0);
}

TEST(TimeLeft, IsTheRestOfTheWorkAtTheRateOfItsKind) {
  TimeLeft time;
  time.add("rk4", 100);
  time.add("cvode", 10);
  time.done("rk4", 50, 5);    // 0.1 s a unit
  time.done("cvode", 2, 20);  // 10 s a unit
  EXPECT_DOUBLE_EQ(*time.seconds({}, 1), 50 * 0.1 + 8 * 10);
  EXPECT_DOUBLE_EQ(*time.seconds({}, 2), (50 * 0.1 + 8 * 10) / 2);
  EXPECT_DOUBLE_EQ(time.share({}), (5.0 + 20) / (10 + 100));
}

TEST(TimeLeft, CountsWorkUnderWay) {
  TimeLeft time;
  time.add("rk4", 100);
  const std::vector<UnderWay> half = {{"rk4", 100, 0.5, 30}};
  EXPECT_DOUBLE_EQ(*time.seconds(half, 1), 30);
  EXPECT_DOUBLE_EQ(time.share(half), 0.5);
}

TEST(TimeLeft, TakesTheRateFromAllOfAKind) {
  TimeLeft time;
  time.add("rk4", 100);
  time.done("rk4", 20, 20);
  const std::vector<UnderWay> two = {{"rk4", 20, 0.5, 20}, {"rk4", 40, 0.25, 30}};  // 10 units in 20 s, 10 in 30 s
  EXPECT_DOUBLE_EQ(*time.seconds(two, 1), 60 * (20.0 + 20 + 30) / 40);
  EXPECT_DOUBLE_EQ(time.share(two), 0.4);
}

TEST(TimeLeft, TakesNoRateFromWorkThatHasHardlyBegun) {
  TimeLeft time;
  time.add("rk4", 100);
  time.done("rk4", 50, 50);
  EXPECT_NEAR(*time.seconds(std::vector<UnderWay>{{"rk4", 50, 0.005, 1000}}, 1), 50 * 0.995, 1e-9);
}

TEST(TimeLeft, IsAtLeastThatOfTheLongestRunUnderWay) {
  TimeLeft time;
  time.add("rk4", 100);
  EXPECT_DOUBLE_EQ(*time.seconds(std::vector<UnderWay>{{"rk4", 100, 0.25, 25}}, 8), 75);
}

TEST(TimeLeft, TakesTheMeanRateForAKindOfWhichNothingIsDone) {
  TimeLeft time;
  time.add("rk4", 10);
  time.add("heun", 5);
  time.done("rk4", 10, 20);
  EXPECT_DOUBLE_EQ(*time.seconds({}, 1), 10);
}

TEST(TimeLeft, IsZeroAtTheEnd) {
  TimeLeft time;
  time.add("rk4", 0.1 + 0.2);
  time.done("rk4", 0.1, 1);
  time.done("rk4", 0.2, 1);
  EXPECT_NEAR(*time.seconds({}, 1), 0, 1e-12);
  EXPECT_NEAR(time.share({}), 1, 1e-12);
}

}  // namespace
}  // namespace polhode::study::time_left_test
