// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/deal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "experiments/study/plan/shard.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::deal_test {
namespace {

Plan plan_of_costs(const std::vector<float>& costs) {
  Plan plan;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    PlanRow row;
    row.id = i;
    row.cost = costs[i];
    plan.rows.push_back(row);
  }
  return plan;
}

std::vector<double> loads(const Plan& plan, const std::vector<std::size_t>& numbers, std::size_t count) {
  std::vector<double> all(count + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i) all[numbers[i]] += plan.rows[i].cost;
  return all;
}

TEST(Shards, HaveEveryRunOnceAndNearlyEqualCosts) {
  std::vector<float> costs;
  for (int i = 0; i < 500; ++i) costs.push_back(static_cast<float>(1 + i % 37 * (i % 5)));
  const Plan plan = plan_of_costs(costs);
  for (const std::size_t count : {1u, 2u, 7u, 64u}) {
    const auto numbers = deal(plan, count);
    const auto all = loads(plan, numbers, count);
    EXPECT_EQ(all[0], 0);
    const auto [least, most] = std::minmax_element(all.begin() + 1, all.end());
    EXPECT_LE(*most - *least, *std::max_element(costs.begin(), costs.end())) << count;
  }
}

TEST(Shards, DoNotDependOnTheOrderOfTheRuns) {
  Plan plan = plan_of_costs({5, 3, 3, 3, 1, 1, 8, 2});
  const auto numbers = deal(plan, 3);
  Plan reversed = plan;
  std::reverse(reversed.rows.begin(), reversed.rows.end());
  auto others = deal(reversed, 3);
  std::reverse(others.begin(), others.end());
  EXPECT_EQ(numbers, others);
}

TEST(Shards, LeaveOutRefusedRuns) {
  Plan plan = plan_of_costs({5, 3, 1});
  plan.rows[0].refused = true;
  EXPECT_THAT(deal(plan, 2), testing::ElementsAre(0, 1, 2));
}

TEST(Shards, AreReadAndRefusedWithTheReason) {
  const Shard shard = read_shard("3/16", "--shard");
  EXPECT_EQ(shard.number, 3u);
  EXPECT_EQ(shard.count, 16u);
  for (const char* wrong : {"", "3", "3/", "/4", "a/4", "3/4x", "-1/4", "0/4", "5/4", "1/0", "1/100001", "3 / 4"}) {
    try {
      read_shard(wrong, "--shard");
      FAIL() << wrong;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("--shard: "));
    }
  }
}

}  // namespace
}  // namespace polhode::study::deal_test
