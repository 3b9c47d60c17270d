// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/quantile_sketch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace polhode::study::quantile_sketch_test {
namespace {

TEST(QuantileSketch, IsWithinItsErrorOfTheSortedValues) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> exponent(-9, 3);
  std::vector<double> values;
  for (int k = 0; k < 20'000; ++k) values.push_back((k % 5 == 0 ? -1 : 1) * std::pow(10, exponent(random)));
  for (int k = 0; k < 500; ++k) values.push_back(0);
  QuantileSketch sketch;
  for (const double value : values) sketch.add(value);
  std::sort(values.begin(), values.end());
  ASSERT_EQ(sketch.count(), values.size());
  for (double share = 0; share <= 1; share += 1.0 / 512) {
    const double exact = values[std::size_t(std::llround(share * double(values.size() - 1)))];
    EXPECT_LE(std::abs(sketch.quantile(share).value() - exact),
              1.0001 * QuantileSketch::relative_error * std::abs(exact))
        << share;
  }
  EXPECT_EQ(sketch.quantile(0), values.front());
  EXPECT_EQ(sketch.quantile(1), values.back());
}

TEST(QuantileSketch, HasNoQuantilesWithoutValues) {
  EXPECT_FALSE(QuantileSketch().quantile(0.5).has_value());
  QuantileSketch one;
  one.add(3);
  EXPECT_EQ(one.quantile(0.5), 3);
}

}  // namespace
}  // namespace polhode::study::quantile_sketch_test
