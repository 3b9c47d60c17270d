// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/run_queue.hpp"

#include <algorithm>
#include <utility>

namespace polhode::study::inline workers {

RunQueue::RunQueue(const Plan& plan, const std::vector<std::uint32_t>& runs, std::size_t workers,
                   std::vector<std::size_t> together)
    : plan_(plan),
      kinds_(plan.kinds.size()),
      together_(std::move(together)),
      shares_(16 * static_cast<double>(workers)) {
  for (const std::uint32_t i : runs) {
    kinds_[plan.rows[i].kind].runs.push_back(i);
    cost_left_ += plan.rows[i].cost;
  }
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
    auto& of_kind = kinds_[kind].runs;
    std::stable_sort(of_kind.begin(), of_kind.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return plan.rows[a].cost > plan.rows[b].cost; });
    wait(kind);
  }
}

/// Puts a kind in line if it has runs left.
void RunQueue::wait(std::size_t kind) {
  const OfKind& of_kind = kinds_[kind];
  if (of_kind.next < of_kind.runs.size()) longest_.emplace(plan_.rows[of_kind.runs[of_kind.next]].cost, kind);
}

std::vector<std::uint32_t> RunQueue::take() {
  const std::lock_guard lock(mutex_);
  std::vector<std::uint32_t> taken;
  if (longest_.empty()) return taken;
  const std::size_t kind = longest_.top().second;
  longest_.pop();
  OfKind& of_kind = kinds_[kind];
  const std::size_t together = together_[kind];
  // Runs that are under way together take as long as one of them.
  const double share = cost_left_ / shares_ * static_cast<double>(together);
  double cost = 0;
  while (of_kind.next < of_kind.runs.size() && taken.size() < most) {
    const std::uint32_t run = of_kind.runs[of_kind.next];
    const double more = plan_.rows[run].cost;
    if (taken.size() >= together && cost + more > share) break;
    cost += more;
    taken.push_back(run);
    ++of_kind.next;
  }
  cost_left_ -= cost;
  wait(kind);
  return taken;
}

}  // namespace polhode::study::workers
