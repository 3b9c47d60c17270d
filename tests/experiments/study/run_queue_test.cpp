// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/run_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace polhode::study::run_queue_test {
namespace {

Plan plan_of(const std::vector<double>& costs, const std::vector<std::uint16_t>& kinds) {
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
  std::vector<double> costs;
  std::vector<std::uint16_t> kinds;
  for (int k = 0; k < 1000; ++k) {
    costs.push_back(1 + k % 13);
    kinds.push_back(k % 3 == 0 ? 1 : 0);
  }
  const Plan plan = plan_of(costs, kinds);
  std::vector<std::uint32_t> order;
  for (const auto& taken : all_taken(plan, 2, {1, 8})) order.insert(order.end(), taken.begin(), taken.end());
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end(),
                             [&](auto a, auto b) { return plan.rows[a].cost > plan.rows[b].cost; }));
  std::sort(order.begin(), order.end());
  EXPECT_EQ(std::adjacent_find(order.begin(), order.end()), order.end());
  EXPECT_EQ(order.size(), 1000u);
}

TEST(RunQueue, GivesLongRunsOneByOne) {
  for (const auto& taken : all_taken(plan_of(std::vector<double>(6, 1e9), std::vector<std::uint16_t>(6)), 2, {1, 8}))
    EXPECT_EQ(taken.size(), 1u);
}

TEST(RunQueue, GivesFullBatchesOfRunsThatAreCarriedOutTogether) {
  const auto all = all_taken(plan_of(std::vector<double>(20, 1e9), std::vector<std::uint16_t>(20, 1)), 2, {1, 8});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].size(), 8u);
  EXPECT_EQ(all[1].size(), 8u);
  EXPECT_EQ(all[2].size(), 4u);
}

TEST(RunQueue, GivesManyShortRunsAtATime) {
  const auto all = all_taken(plan_of(std::vector<double>(100'000, 1), std::vector<std::uint16_t>(100'000)), 2, {1, 8});
  EXPECT_EQ(all.front().size(), 64u);
  EXPECT_EQ(all.back().size(), 1u);
}

}  // namespace
}  // namespace polhode::study::run_queue_test
