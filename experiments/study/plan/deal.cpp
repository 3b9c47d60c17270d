// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/deal.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace polhode::study::inline plan {
std::vector<std::size_t> deal(const Plan& plan, std::size_t count) {
  std::vector<std::size_t> order(plan.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const PlanRow &one = plan.rows[a], &other = plan.rows[b];
    return one.cost != other.cost ? one.cost > other.cost : one.id < other.id;
  });
  using Load = std::pair<double, std::size_t>;  // cost, number of the shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::size_t number = 1; number <= count; ++number) loads.emplace(0.0, number);
  std::vector<std::size_t> numbers(plan.size());
  for (const std::size_t i : order) {
    if (plan.rows[i].refused) continue;
    auto [cost, number] = loads.top();
    loads.pop();
    numbers[i] = number;
    loads.emplace(cost + plan.rows[i].cost, number);
  }
  return numbers;
}

}  // namespace polhode::study::plan
