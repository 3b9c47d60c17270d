// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/run_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace polhode::study::run_order_test {
namespace {

using Key = std::vector<OptionValue>;

std::vector<std::uint32_t> order_of(const std::vector<Key>& keys) {
  RunOrder order;
  for (const Key& key : keys) order.add(key);
  return order.sorted([](std::uint32_t a, std::uint32_t b) { return a < b; });
}

TEST(RunOrder, IsThatOfTheKeys) {
  const std::vector<OptionValue> values = {{},  std::int64_t{-3}, std::int64_t{7}, -1e300,      -2.5, -0.0, 0.0, 1e-310,
                                           3.0, std::string(),    "rk4",           "lie_euler", "rk"};
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Key> keys(1 + random() % 20, Key(4));
    for (Key& key : keys) {
      for (OptionValue& value : key) value = values[random() % values.size()];
      key[1] = values[5];  // equal in all runs
    }
    std::vector<std::uint32_t> expected(keys.size());
    std::iota(expected.begin(), expected.end(), 0U);
    std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
    EXPECT_EQ(order_of(keys), expected);
  }
}

TEST(RunOrder, OfEqualKeysIsTheGivenOne) {
  RunOrder order;
  for (int k = 0; k < 3; ++k) order.add({1.0, "a"});
  EXPECT_EQ(order.sorted([](auto a, auto b) { return a > b; }), (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(RunOrder, CountsTheValuesAndNamesTheFirstRunsThatHaveThem) {
  RunOrder order;
  order.add({1.0, "a", 5.0});
  order.add({2.0, "a"}, {5.0});  // in two parts
  order.add({1.0}, {"b", 5.0});
  order.add({std::int64_t{1}, {}, 5.0});
  order.add({{}, "b", 5.0});
  const std::vector<RunOrder::Values> values = order.values(std::vector<std::uint32_t>{3, 2, 0, 1, 4}, 3);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0].count, 4u);
  EXPECT_EQ(values[0].runs, (std::vector<std::uint32_t>{3, 2, 1}));
  EXPECT_EQ(values[1].count, 3u);
  EXPECT_EQ(values[1].runs, (std::vector<std::uint32_t>{3, 2, 0}));
  EXPECT_EQ(values[2].count, 1u);
  EXPECT_EQ(values[2].runs, (std::vector<std::uint32_t>{3}));
}

}  // namespace
}  // namespace polhode::study::run_order_test
