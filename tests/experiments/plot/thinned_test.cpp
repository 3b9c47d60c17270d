// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plot/thinned.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace polhode::study::plot_program::thinned_test {
namespace {

TEST(ThinnedCurve, KeepsAFewValues) {
  ThinnedCurve curve(4);
  for (int i = 0; i < 4; ++i) curve.add(i, i * i);
  const auto points = curve.points();
  ASSERT_EQ(points.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(points[std::size_t(i)].y, i * i);
}

TEST(ThinnedCurve, KeepsEveryExtremeOfALongSeries) {
  ThinnedCurve curve(64);
  const int n = 100'000;
  for (int i = 0; i < n; ++i) curve.add(i, i == 77'777 ? 9 : i == 12'345 ? -9 : std::sin(0.001 * i));
  const auto points = curve.points();
  EXPECT_LE(points.size(), 4U * 64U);
  EXPECT_GE(points.size(), 2U * 32U);
  const auto has = [&](double t, double y) {
    return std::any_of(points.begin(), points.end(), [&](const auto& p) { return p.t == t && p.y == y; });
  };
  EXPECT_TRUE(has(77'777, 9));
  EXPECT_TRUE(has(12'345, -9));
  EXPECT_TRUE(has(0, 0));
  EXPECT_EQ(points.back().t, n - 1);
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.t < b.t; }));
}

}  // namespace
}  // namespace polhode::study::plot_program::thinned_test
