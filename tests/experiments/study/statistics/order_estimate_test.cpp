// SPDX-License-Identifier: BSD-3-Clause
// Orders estimated from made-up ladders whose order, noise and floor are known.
#include "experiments/study/statistics/order_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace polhode::study::order_estimate_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<LadderPoint> ladder(int n, const std::function<double(double)>& error, double round_off = 1e-15) {
  std::vector<LadderPoint> points;
  for (int i = 0; i < n; ++i) {
    const double h = 0.1 * std::pow(0.5, i);
    points.push_back({h, error(h), round_off});
  }
  return points;
}

TEST(OrderEstimate, OfAPowerLawIsItsExponentWithNoDoubt) {
  for (const double p : {1.0, 2.0, 3.5, 6.0}) {
    const auto e = estimate_order(ladder(
        6, [p](double h) { return 3 * std::pow(h, p); }, 0));
    ASSERT_TRUE(e.line) << p;
    EXPECT_NEAR(e.line->order, p, 1e-10);
    EXPECT_NEAR(e.line->half_width_95, 0, 1e-7);
    EXPECT_EQ(e.points, 6U);
    EXPECT_EQ(e.blown_up + e.at_round_off + e.not_straight, 0U);
    EXPECT_DOUBLE_EQ(e.largest, 0.1);
    EXPECT_DOUBLE_EQ(e.smallest, 0.1 / 32);
    EXPECT_EQ(order_verdict(e, p), OrderVerdict::as_declared);
    EXPECT_EQ(order_verdict(e, p + 0.3), OrderVerdict::lower);
    EXPECT_EQ(order_verdict(e, p - 0.3), OrderVerdict::higher);
    EXPECT_EQ(order_verdict(e, std::nullopt), OrderVerdict::lower) << "declared to be exact";
  }
}

TEST(OrderEstimate, ItsIntervalIsStudentsT) {
  // ln e = 2 ln h + noise
  const std::vector<double> x = {-2, -1, 0, 1, 2}, noise = {0.02, -0.04, 0.04, -0.04, 0.02};
  std::vector<LadderPoint> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({std::exp(x[i]), std::exp(2 * x[i] + noise[i]), 0});
  const auto e = estimate_order(points);
  ASSERT_TRUE(e.line);
  // Σ x² = 10, Σ x·noise = 0, Σ (noise − mean)² = 0.0056: standard error √(0.0056/3/10), t(0.975; 3) = 3.182446305.
  EXPECT_NEAR(e.line->order, 2, 1e-12);
  EXPECT_NEAR(e.line->standard_error, std::sqrt(0.0056 / 30), 1e-12);
  EXPECT_NEAR(e.line->half_width_95, 3.182446305 * std::sqrt(0.0056 / 30), 1e-9);
}

TEST(OrderEstimate, TheIntervalHoldsTheOrderNineteenTimesOutOfTwenty) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.02);
  int held = 0;
  constexpr int trials = 2000;
  for (int k = 0; k < trials; ++k) {
    const auto e = estimate_order(ladder(
                                      8, [&](double h) { return h * h * std::exp(noise(random)); }, 0),
                                  {.straightness = std::numeric_limits<double>::infinity()});
    ASSERT_TRUE(e.line);
    held += std::abs(e.line->order - 2) <= e.line->half_width_95 ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.02);
}

TEST(OrderEstimate, LeavesOutARoundOffFloor) {
  const auto e = estimate_order(ladder(12, [](double h) { return std::pow(h, 4) + 2e-12; }));
  ASSERT_TRUE(e.line);
  EXPECT_NEAR(e.line->order, 4, 0.05);
  EXPECT_GE(e.at_round_off, 5U);
  EXPECT_EQ(e.points + e.at_round_off + e.not_straight, 12U);

  // A floor that rises as the steps shrink, as rounding does.
  const auto rising = estimate_order(ladder(12, [](double h) { return std::pow(h, 4) + 1e-15 / h; }));
  ASSERT_TRUE(rising.line);
  EXPECT_NEAR(rising.line->order, 4, 0.05);
}

/// Errors at 1/1280 s, 1/640 s, … from the smallest step on, as they were measured.
std::vector<LadderPoint> measured(const std::vector<double>& errors) {
  std::vector<LadderPoint> points;
  double step = 1.0 / 1280;
  for (const double error : errors) points.push_back({step, error, 4e-13}), step *= 2;
  return points;
}

TEST(OrderEstimate, KnowsRoundingThatGoesUpAndDown) {
  // dmv6 on peters_hsu: from 1/320 s down the errors are rounding, though the last step happens to bring less.
  const auto e = estimate_order(measured({1.2e-10, 1.7e-10, 7.4e-11, 9.6e-11, 4.1e-9, 2.6e-7, 1.7e-5, 1.2e-3}));
  ASSERT_TRUE(e.line);
  EXPECT_NEAR(e.line->order, 6, 0.1);
  EXPECT_EQ(e.at_round_off, 4U);
  EXPECT_GE(e.floor, 1.2e-10);
  // exact_rotor on peters_hsu: the floor of an unstable motion, which is no order.
  const auto none =
      estimate_order(measured({6.9e-10, 8.3e-11, 2.5e-10, 1.2e-10, 6.0e-11, 1.6e-11, 2.1e-11, 2.1e-11, 2.3e-11}));
  EXPECT_FALSE(none.line);
  EXPECT_EQ(none.at_round_off, 9U);
}

TEST(OrderEstimate, LeavesOutASmallestStepThatBendsAStraightLine) {
  const auto e = estimate_order(measured({1.64e-11, 4.52e-10, 7.46e-9, 1.20e-7, 1.91e-6, 3.06e-5, 4.87e-4}));  // gauss4
  ASSERT_TRUE(e.line);
  EXPECT_NEAR(e.line->order, 4, 0.01);
  EXPECT_LT(e.line->half_width_95, 0.05);
  EXPECT_EQ(e.at_round_off, 1U);
  EXPECT_TRUE(e.straight);
}

TEST(OrderEstimate, TakesNoErrorOfWhichNoDigitIsProvenForAnOrderOrForExactness) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  auto points = ladder(6, [](double h) { return h * h; });
  points.back() = {points.back().step, 0, infinite};
  const auto e = estimate_order(points);
  ASSERT_TRUE(e.line);
  EXPECT_NEAR(e.line->order, 2, 1e-9);
  EXPECT_EQ(e.points, 5U);
  for (auto& p : points) p.error = 0, p.round_off = infinite;
  EXPECT_FALSE(estimate_order(points).exact);
}

TEST(OrderEstimate, KnowsAPlateauThatIsNoRounding) {
  const auto e = estimate_order(ladder(8, [](double) { return 0.03; }));
  ASSERT_TRUE(e.line);
  EXPECT_NEAR(e.line->order, 0, 1e-12);
  EXPECT_EQ(e.points, 8U);
  EXPECT_EQ(order_verdict(e, 1), OrderVerdict::lower);
}

TEST(OrderEstimate, LeavesOutStepsAtWhichTheMotionIsLostAndLargerOnes) {
  auto points = ladder(8, [](double h) { return 40 * h * h; });
  points[2].error = nan;  // 0.025 s diverged: what 0.1 s and 0.05 s say is chance
  const auto e = estimate_order(points, {.lost = 0.5});
  ASSERT_TRUE(e.line);
  EXPECT_EQ(e.blown_up, 3U);
  EXPECT_EQ(e.points, 5U);
  EXPECT_DOUBLE_EQ(e.largest, 0.0125);
  EXPECT_NEAR(e.line->order, 2, 1e-9);

  points = ladder(8, [](double h) { return 4000 * h * h; });
  points[1].error = 0.3;  // by chance, between larger and smaller steps that are lost
  EXPECT_EQ(estimate_order(points, {.lost = 0.5}).blown_up, 4U) << "0.0125 s: 0.625 rad";
}

TEST(OrderEstimate, BeginsAtTheSmallestStepsAndStopsWhereTheLineBends) {
  // Second order hidden below a fourth-order term at large steps.
  const auto e = estimate_order(ladder(10, [](double h) { return h * h + 2e4 * std::pow(h, 4); }));
  ASSERT_TRUE(e.line);
  EXPECT_NEAR(e.line->order, 2, 0.1);
  EXPECT_GE(e.not_straight, 3U);
  EXPECT_DOUBLE_EQ(e.smallest, 0.1 / 512);
}

TEST(OrderEstimate, OfTooFewPointsIsNotSeen) {
  EXPECT_FALSE(estimate_order({}).line);
  EXPECT_FALSE(estimate_order({}).exact);
  EXPECT_EQ(order_verdict(estimate_order({}), 2), OrderVerdict::too_few);
  const auto one = estimate_order({{0.1, 1e-3, 0}});
  EXPECT_FALSE(one.line);
  EXPECT_EQ(one.points, 1U);
  EXPECT_EQ(order_verdict(one, 2), OrderVerdict::too_few);
  EXPECT_EQ(order_verdict(estimate_order({{0.1, 1e-2, 0}, {0.05, 1e-3, 0}}), 2), OrderVerdict::too_few);
  const auto none_left = estimate_order({{0.1, nan, 0}, {0.05, nan, 0}, {0.025, nan, 0}});
  EXPECT_FALSE(none_left.line);
  EXPECT_EQ(none_left.blown_up, 3U);
  EXPECT_FALSE(none_left.exact);
  // The same step twice is one point: no slope.
  EXPECT_EQ(estimate_order({{0.1, 1e-2, 0}, {0.1, 2e-2, 0}, {0.1, 3e-2, 0}}).points, 1U);
}

TEST(OrderEstimate, OfExactMethodsIsNoOrder) {
  const auto e = estimate_order(ladder(6, [](double) { return 3e-15; }));
  EXPECT_TRUE(e.exact);
  EXPECT_FALSE(e.line);
  EXPECT_EQ(order_verdict(e, std::nullopt), OrderVerdict::as_declared);
  EXPECT_EQ(order_verdict(e, 2), OrderVerdict::exact_here);
  const auto zero = estimate_order(ladder(
      6, [](double) { return 0.0; }, 0));
  EXPECT_TRUE(zero.exact);
}

TEST(OrderEstimate, ThatScattersDecidesNothing) {
  int i = 0;
  const auto e = estimate_order(ladder(6, [&](double h) { return h * h * (++i % 2 == 0 ? 4 : 0.25); }));
  ASSERT_TRUE(e.line);
  EXPECT_GT(e.line->half_width_95, 0.5);
  EXPECT_EQ(order_verdict(e, 2), OrderVerdict::scattered);
  EXPECT_EQ(order_verdict(e, 6), OrderVerdict::scattered);

  // An interval that reaches beyond the limit between declared and not declared.
  OrderEstimate near;
  near.line = OrderEstimate::Line{2.3, 0.1, 0.4};
  EXPECT_EQ(order_verdict(near, 2), OrderVerdict::scattered);
  near.line->half_width_95 = 0.2;
  EXPECT_EQ(order_verdict(near, 2), OrderVerdict::higher);
}

TEST(OrderEstimate, DoesNotDependOnTheOrderOfThePoints) {
  auto points = ladder(7, [](double h) { return std::pow(h, 3) * (1 + h); });
  const auto a = estimate_order(points);
  std::mt19937 random(3);
  std::shuffle(points.begin(), points.end(), random);
  const auto b = estimate_order(points);
  ASSERT_TRUE(a.line && b.line);
  EXPECT_EQ(a.line->order, b.line->order);
  EXPECT_EQ(a.points, b.points);
}

}  // namespace
}  // namespace polhode::study::order_estimate_test
