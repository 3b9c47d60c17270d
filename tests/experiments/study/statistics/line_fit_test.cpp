// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/line_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace polhode::study::line_fit_test {
namespace {

TEST(LineFit, GoesThroughPointsOnALine) {
  const LineFit line = fit_line(std::vector<LinePoint>{{-2, 7}, {1, 1}, {4, -5}});
  EXPECT_DOUBLE_EQ(line.slope, -2);
  EXPECT_NEAR(line.standard_error, 0, 1e-15);
  EXPECT_NEAR(line.worst, 0, 1e-14);
}

/// Anscombe, "Graphs in Statistical Analysis", The American Statistician 27 (1973): his first set and its printed fit.
TEST(LineFit, IsAnscombes) {
  const std::vector<LinePoint> points = {{10, 8.04}, {8, 6.95}, {13, 7.58},  {9, 8.81}, {11, 8.33}, {14, 9.96},
                                         {6, 7.24},  {4, 4.26}, {12, 10.84}, {7, 4.82}, {5, 5.68}};
  const LineFit line = fit_line(points);
  EXPECT_NEAR(line.slope, 0.500, 5e-4);
  EXPECT_NEAR(line.standard_error, 0.118, 5e-4);
  EXPECT_NEAR(line.worst, std::abs(7.58 - (3.0001 + 0.5001 * 13)), 1e-3);
}

TEST(LineFit, HasNoSlopeWhereAllXAreOne) {
  EXPECT_FALSE(std::isfinite(fit_line(std::vector<LinePoint>{{1, 2}, {1, 3}, {1, 4}}).slope));
}

}  // namespace
}  // namespace polhode::study::line_fit_test
