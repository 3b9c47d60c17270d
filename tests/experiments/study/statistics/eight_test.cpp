// SPDX-License-Identifier: BSD-3-Clause
// Sums in eight parts, whose order of additions no width of the registers changes.
#include "experiments/study/statistics/eight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace polhode::study::eight_test {
namespace {

using namespace polhode::study::spectral;

std::vector<double> numbers_of_many_sizes(std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> numbers(count);
  for (double& x : numbers) x = normal(random) * std::exp(10 * normal(random));
  return numbers;
}

TEST(EightNumbers, AddUpInTheOrderThatIsPromised) {
  const std::vector<double> all = numbers_of_many_sizes(40);
  for (std::ptrdiff_t n = 0; n <= 40; ++n) {
    std::array<double, 8> s = {};
    for (std::ptrdiff_t i = 0; i < n; ++i) s[std::size_t(i % 8)] += all[std::size_t(i)];
    const double expected = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
    EXPECT_EQ(sum(all.data(), n), expected) << n;
  }
}

TEST(EightNumbers, AreEachCombinedWithTheOneAtItsPlace) {
  const std::vector<double> all = numbers_of_many_sizes(16);
  const Eight a = eight(all.data()), b = eight(all.data() + 8);
  std::array<double, 8> found;
  const auto expect = [&](const Eight& combined, const auto& of) {
    combined.write(found.data());
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(found[i], of(all[i], all[i + 8])) << i;
  };
  expect(a + b, [](double x, double y) { return x + y; });
  expect(a - b, [](double x, double y) { return x - y; });
  expect(a * b, [](double x, double y) { return x * y; });
  expect(3 * a, [](double x, double) { return 3 * x; });
  expect(abs(a), [](double x, double) { return std::abs(x); });
  expect(larger(a, b), [](double x, double y) { return y > x ? y : x; });
  for (std::ptrdiff_t count = 0; count <= 8; ++count) {
    eight(all.data(), count).write(found.data());
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(found[i], std::ptrdiff_t(i) < count ? all[i] : 0) << count;
  }
}

TEST(EightNumbers, HaveALargestDistanceThatNoNaNChanges) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t n : {1u, 7u, 8u, 9u, 30u}) {
    for (std::size_t at = 0; at < n; ++at) {
      std::vector<double> numbers(n, 2);
      numbers[at] = -5;
      EXPECT_EQ(largest_distance(numbers.data(), std::ptrdiff_t(n), 1), 6) << n << ", " << at;
      EXPECT_TRUE(all_finite(numbers.data(), std::ptrdiff_t(n)));
      numbers[at] = nan;
      EXPECT_EQ(largest_distance(numbers.data(), std::ptrdiff_t(n), 1), n > 1 ? 1 : 0) << n << ", " << at;
      EXPECT_FALSE(all_finite(numbers.data(), std::ptrdiff_t(n))) << n << ", " << at;
    }
  }
}

}  // namespace
}  // namespace polhode::study::eight_test
