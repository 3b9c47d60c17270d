// SPDX-License-Identifier: BSD-3-Clause
// Lower envelopes of made-up work-precision curves.
#include "experiments/study/curves/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace polhode::study::envelope_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// error = (scale / cost)^order at cost = 10, 20, 40, …
std::vector<WorkPoint> curve(double scale, double order, int n = 12) {
  std::vector<WorkPoint> points;
  for (int i = 0; i < n; ++i) {
    const double cost = 10 * std::pow(2.0, i);
    points.push_back({std::pow(scale / cost, order), cost});
  }
  return points;
}

TEST(CostToReach, LiesOnTheLineOfTheLogarithms) {
  for (const double error : {1e-2, 1e-4, 3e-6}) {
    EXPECT_NEAR(cost_to_reach(error, curve(10, 2)).value(), 10 / std::sqrt(error), 1e-9 / std::sqrt(error)) << error;
  }
}

TEST(CostToReach, IsNeverExtrapolated) {
  const std::vector<WorkPoint> points = {{1e-3, 100}, {1e-5, 300}};
  EXPECT_EQ(cost_to_reach(1e-1, points), 100);
  EXPECT_FALSE(cost_to_reach(1e-6, points));
  EXPECT_EQ(cost_to_reach(1e-5, points), 300);
  EXPECT_FALSE(cost_to_reach(1e-5, {}));
}

TEST(CostToReach, LeavesOutWhatIsNoNumberAndNeedsNoOrder) {
  const std::vector<WorkPoint> points = {{1e-6, 1000}, {nan, 500}, {1e-2, 10}, {0, 20}, {1e-9, 0}, {1e-4, 100}};
  EXPECT_NEAR(cost_to_reach(1e-3, points).value(), std::sqrt(1000.0), 1e-9);
  EXPECT_FALSE(cost_to_reach(1e-9, points));
}

TEST(CostToReach, OfOnePointIsThatPoint) {
  EXPECT_EQ(cost_to_reach(1e-2, {{1e-3, 7}}), 7);
  EXPECT_FALSE(cost_to_reach(1e-4, {{1e-3, 7}}));
}

TEST(LowerEnvelope, ChangesHandsWhereTheCurvesCross) {
  // (100/c)⁴ and (10/c)¹: they cross at c = 100·10^(1/3) = 215, error = 0.046.
  const auto envelope = lower_envelope({curve(10, 1), curve(100, 4)}, 1);
  ASSERT_GE(envelope.size(), 6U);
  EXPECT_EQ(envelope.front().decade, -1);
  for (const auto& p : envelope) {
    EXPECT_EQ(p.curve, p.decade >= -1 ? 0U : 1U) << p.decade;
    const double error = std::pow(10.0, p.decade);
    EXPECT_NEAR(p.cost, p.curve == 0 ? 10 / error : 100 / std::pow(error, 0.25), 1e-6 * p.cost);
    if (p.decade == -2) {
      EXPECT_EQ(p.next, 0U);
      EXPECT_NEAR(p.next_cost, 1000, 1e-3);
    }
  }
  EXPECT_FALSE(envelope.back().next) << "the first curve never gets there";
}

TEST(LowerEnvelope, SaysWhereACostIsNoMoreThanABound) {
  const auto envelope = lower_envelope({{{1e-3, 50}, {1e-6, 500}}, {{0.5, 40}, {1e-2, 4000}}}, 1);
  ASSERT_EQ(envelope.size(), 6U);
  EXPECT_EQ(envelope[0].decade, -1);
  EXPECT_EQ(envelope[0].curve, 0U);
  EXPECT_TRUE(envelope[0].at_most);
  EXPECT_TRUE(envelope[1].at_most);
  EXPECT_FALSE(envelope[2].at_most) << "1e-3 is the first run itself";
  EXPECT_FALSE(envelope[5].at_most);
  EXPECT_EQ(envelope[5].decade, -6);
}

TEST(LowerEnvelope, HasNothingToSayOfLostMotionsAndEmptyCurves) {
  EXPECT_TRUE(lower_envelope({}, 1).empty());
  EXPECT_TRUE(lower_envelope({{}, {{nan, 10}}, {{2.5, 10}, {3, 20}}}, 1).empty());
  const auto envelope = lower_envelope({{}, {{2, 10}, {0.01, 20}}}, 1);
  ASSERT_EQ(envelope.size(), 1U) << "one decade, one run";
  EXPECT_EQ(envelope[0].curve, 1U);
  EXPECT_EQ(envelope[0].cost, 20);
}

TEST(LowerEnvelope, OfEqualsNamesTheFirst) {
  const auto envelope = lower_envelope({curve(10, 2), curve(10, 2)}, 1);
  for (const auto& p : envelope) {
    EXPECT_EQ(p.curve, 0U);
    EXPECT_EQ(p.next, 1U);
  }
}

}  // namespace
}  // namespace polhode::study::envelope_test
