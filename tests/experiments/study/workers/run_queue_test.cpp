// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/run_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace polhode::study::run_queue_test {
namespace {

Plan plan_of(const std::vector<float>& costs, const std::vector<std::uint16_t>& kinds) {
  Plan plan;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    PlanRow row;
    row.id = i;
    row.cost = costs[i];
    row.kind = kinds[i];
    plan.rows.push_back(row);
  }
  plan.kinds = {"alone", "in lanes"};
  return plan;
}

std::vector<std::vector<std::uint32_t>> all_taken(const Plan& plan, std::size_t workers,
                                                  std::vector<std::size_t> together) {
  std::vector<std::uint32_t> runs(plan.size());
  std::iota(runs.begin(), runs.end(), 0U);
  RunQueue queue(plan, runs, workers, std::move(together));
  std::vector<std::vector<std::uint32_t>> all;
  for (std::vector<std::uint32_t> taken = queue.take(); !taken.empty(); taken = queue.take()) all.push_back(taken);
  return all;
}

TEST(RunQueue, GivesEachRunOnceTheLongestFirst) {
  std::vector<float> costs;
  std::vector<std::uint16_t> kinds;
  for (int k = 0; k < 1000; ++k) {
    costs.push_back(static_cast<float>(1 + k % 13));
    kinds.push_back(k % 3 == 0 ? 1 : 0);
  }
  const Plan plan = plan_of(costs, kinds);
  std::vector<std::uint32_t> order;
  std::vector<float> left = costs;
  for (const auto& taken : all_taken(plan, 2, {1, 8})) {
    EXPECT_EQ(plan.rows[taken.front()].cost, *std::max_element(left.begin(), left.end()));
    for (const std::uint32_t i : taken) {
      EXPECT_EQ(kinds[i], kinds[taken.front()]);
      left[i] = 0;
    }
    EXPECT_TRUE(std::is_sorted(taken.begin(), taken.end(),
                               [&](auto a, auto b) { return plan.rows[a].cost > plan.rows[b].cost; }));
    order.insert(order.end(), taken.begin(), taken.end());
  }
  std::sort(order.begin(), order.end());
  EXPECT_EQ(std::adjacent_find(order.begin(), order.end()), order.end());
  EXPECT_EQ(order.size(), 1000u);
}

TEST(RunQueue, GivesLongRunsOneByOne) {
  for (const auto& taken : all_taken(plan_of(std::vector<float>(6, 1e9F), std::vector<std::uint16_t>(6)), 2, {1, 8}))
    EXPECT_EQ(taken.size(), 1u);
}

TEST(RunQueue, FillsTheLanesOfABatchAndKeepsWorkForTheOthers) {
  const auto all = all_taken(plan_of(std::vector<float>(200, 1e9F), std::vector<std::uint16_t>(200, 1)), 2, {1, 8});
  EXPECT_GT(all.size(), 4u);
  EXPECT_LE(all.front().size(), 64u);
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    EXPECT_GE(all[k].size(), 8u) << k;
    EXPECT_GE(all[k].size(), all[k + 1].size()) << k;
  }
}

TEST(RunQueue, GivesManyShortRunsAtATime) {
  const auto all = all_taken(plan_of(std::vector<float>(100'000, 1), std::vector<std::uint16_t>(100'000)), 2, {1, 8});
  EXPECT_EQ(all.front().size(), 64u);
  EXPECT_EQ(all.back().size(), 1u);
}

}  // namespace
}  // namespace polhode::study::run_queue_test
