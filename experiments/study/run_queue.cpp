// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/run_queue.hpp"

#include <algorithm>
#include <utility>

namespace polhode::study {

RunQueue::RunQueue(const Plan& plan, std::vector<std::uint32_t> runs, std::size_t workers,
                   std::vector<std::size_t> together)
    : plan_(plan), runs_(std::move(runs)), together_(std::move(together)), shares_(16 * static_cast<double>(workers)) {
  std::stable_sort(runs_.begin(), runs_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return plan.rows[a].cost > plan.rows[b].cost; });
  for (const std::uint32_t i : runs_) cost_left_ += plan.rows[i].cost;
}

std::vector<std::uint32_t> RunQueue::take() {
  const std::lock_guard lock(mutex_);
  std::vector<std::uint32_t> taken;
  double cost = 0;
  const double share = cost_left_ / shares_;
  while (next_ < runs_.size() && taken.size() < most) {
    const PlanRow& row = plan_.rows[runs_[next_]];
    if (!taken.empty() && cost + row.cost > share) {
      const PlanRow& first = plan_.rows[taken.front()];
      if (row.kind != first.kind || taken.size() % together_[first.kind] == 0) break;
    }
    cost += row.cost;
    taken.push_back(runs_[next_++]);
  }
  cost_left_ -= cost;
  return taken;
}

}  // namespace polhode::study
