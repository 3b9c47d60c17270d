// SPDX-License-Identifier: BSD-3-Clause
// The symmetric logarithmic axis.
#include "experiments/study/plot/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polhode::study::report_tests::axis_test {
namespace {

TEST(ReportAxis, SymlogGoesThereAndBack) {
  const auto axis = symlog_axis("y", -1e-3, 1e2, 1e-9);
  EXPECT_DOUBLE_EQ(axis.threshold, 1e-11);
  for (const double y : {-1e-3, -1e-12, 0.0, 1e-11, 3e-5, 99.0})
    EXPECT_NEAR(axis.value_at(axis.place(y)), y, 1e-12 * std::abs(y));
  EXPECT_LT(axis.low, -1e-3);
  EXPECT_GT(axis.high, 1e2);
  EXPECT_LE(axis.ticks.size(), 12U);
}

TEST(Labels, OfTicksThatStandCloseTogetherAreLeftOut) {
  const Axis axis = linear_axis("x", 0, 10);  // ticks 2 apart
  EXPECT_EQ(labels_apart(axis, 100, 19), 1U);
  EXPECT_EQ(labels_apart(axis, 100, 21), 2U);
  EXPECT_EQ(labels_apart(axis, 100, 59), 3U);
}

}  // namespace
}  // namespace polhode::study::report_tests::axis_test
