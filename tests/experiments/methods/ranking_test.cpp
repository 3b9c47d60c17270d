// SPDX-License-Identifier: BSD-3-Clause
// The comparisons of contenders, on costs that are given by hand.
#include "experiments/methods/ranking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace polhode::study::methods::ranking_test {
namespace {

/// Costs of contenders a, b, c (columns) on problems (rows) of one group, the same for all errors; 0: not reached,
/// negative: exact.
Costs costs(const std::vector<std::vector<double>>& table) {
  Costs made;
  made.groups = {{"tops", "Tops", Measure::motion, {}}};
  for (std::size_t c = 0; c < table.front().size(); ++c)
    made.contenders.push_back({std::string(1, static_cast<char>('a' + c)), "quaternion", false});
  for (std::size_t p = 0; p < table.size(); ++p) {
    made.problems.push_back({"problem " + std::to_string(p), 0, 1.0});
    auto& row = made.reach.emplace_back();
    for (const double cost : table[p]) {
      Reach reach{.tried = true, .ran = true, .measured = true, .exact = cost < 0};
      for (auto& at : reach.cost) {
        if (cost != 0) at = std::abs(cost);
      }
      row.push_back(reach);
    }
  }
  return made;
}

bool anyone(std::size_t) { return true; }

std::vector<std::size_t> order(const std::vector<Ranked>& ranked) {
  std::vector<std::size_t> found;
  for (const Ranked& r : ranked) found.push_back(r.contender);
  return found;
}

TEST(Ranking, TheContenderThatSolvesMoreComesFirstThenTheCheaperOne) {
  const Costs made = costs({{10, 1, 40}, {10, 0, 10}});
  const std::vector<std::size_t> both = {0, 1};
  const auto ranked = ranking(made, tasks_of(both, 0), anyone);
  EXPECT_EQ(order(ranked), (std::vector<std::size_t>{0, 2, 1}));
  EXPECT_EQ(ranked[2].solved, 1u);
  EXPECT_NEAR(ranked[0].log_ratio, std::log(10.0) / 2, 1e-15);
  EXPECT_NEAR(ranked[1].log_ratio, std::log(40.0) / 2, 1e-15);
}

TEST(Ranking, AContenderThatIsExactEverywhereDoesNotCompeteAndOneThatIsExactSomewhereDoes) {
  const Costs made = costs({{-1, 10, -1}, {-1, 10, 30}});
  const std::vector<std::size_t> both = {0, 1};
  const auto ranked = ranking(made, tasks_of(both, 0), anyone);
  EXPECT_EQ(order(ranked), (std::vector<std::size_t>{1, 2}));
  EXPECT_NEAR(ranked[1].log_ratio, std::log(3.0) / 2, 1e-15);  // nothing for the problem that it solves exactly
  EXPECT_EQ(exact_on_all(made, both), (std::vector<std::size_t>{0}));
}

TEST(Ranking, ARunnerUpIsOfAnotherMethod) {
  Costs made = costs({{1, 2, 3}});
  made.contenders[1].method = "a";
  const std::vector<std::size_t> one = {0};
  const auto ranked = ranking(made, tasks_of(one, 0), anyone);
  ASSERT_NE(runner_up(made, ranked), nullptr);
  EXPECT_EQ(runner_up(made, ranked)->contender, 2u);
}

TEST(Regrets, AreWhatTheRecommendationOfTheOthersCosts) {
  const Costs made = costs({{1, 3}, {1, 3}, {8, 2}});
  std::vector<double> ratios;
  for (const Regret& r : regrets(made, anyone)) {
    if (r.task.target != 0) continue;
    ratios.push_back(r.ratio);
    EXPECT_EQ(r.recommended, r.task.problem == 2 ? 0u : r.recommended);
  }
  // Without problem 0 or 1: a has ratios 1 and 4, b 3 and 1, so that b comes first and costs 3 times as much. Without
  // problem 2 a is recommended, which costs 4 times as much on it.
  EXPECT_EQ(ratios, (std::vector<double>{3, 3, 4}));
}

TEST(Regrets, AreInfiniteWhereTheRecommendationDoesNotReachTheError) {
  const Costs made = costs({{1, 3}, {1, 3}, {0, 2}});
  std::size_t infinite = 0;
  for (const Regret& r : regrets(made, anyone)) infinite += std::isinf(r.ratio);
  EXPECT_EQ(infinite, targets);
}

TEST(Regrets, NeedThreeProblems) { EXPECT_TRUE(regrets(costs({{1, 3}, {1, 3}}), anyone).empty()); }

TEST(PairRatio, IsTheGeometricMeanOverProblemsWithAnIntervalThatHoldsIt) {
  const Costs made = costs({{1, 2}, {1, 8}, {5, 0}, {-1, 4}});
  const std::vector<std::size_t> all = {0, 1, 2, 3};
  const PairRatio pair = pair_ratio(made, all, 1, 0);
  EXPECT_EQ(pair.problems, 2u);
  EXPECT_EQ(pair.tasks, 2 * targets);
  EXPECT_EQ(pair.only_second, targets);
  EXPECT_EQ(pair.only_first, 0u);
  EXPECT_NEAR(pair.ratio, 4, 1e-12);
  EXPECT_NEAR(pair.low, 2, 1e-12);  // two problems: a sample holds one of them twice in a quarter of the cases
  EXPECT_NEAR(pair.high, 8, 1e-12);
}

TEST(PairRatio, DoesNotDependOnOtherContenders) {
  const Costs with = costs({{1, 2, 0.1}, {1, 8, 9}}), without = costs({{1, 2}, {1, 8}});
  const std::vector<std::size_t> all = {0, 1};
  EXPECT_EQ(pair_ratio(with, all, 1, 0).ratio, pair_ratio(without, all, 1, 0).ratio);
  EXPECT_EQ(pair_ratio(with, all, 1, 0).low, pair_ratio(without, all, 1, 0).low);
}

TEST(Quantile, IsReachedByAtLeastThatShare) {
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(quantile({3, 1, 2, never}, 0.5), 2);
  EXPECT_EQ(quantile({3, 1, 2, never}, 0.75), 3);
  EXPECT_EQ(quantile({3, 1, 2, never}, 0.9), never);
  EXPECT_EQ(quantile({5}, 0.5), 5);
}

}  // namespace
}  // namespace polhode::study::methods::ranking_test
