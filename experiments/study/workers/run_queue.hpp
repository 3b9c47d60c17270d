// SPDX-License-Identifier: BSD-3-Clause
// The order in which workers take the runs of a plan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <queue>
#include <utility>
#include <vector>

#include "experiments/study/plan/plan.hpp"

namespace polhode::study::inline workers {

/// Gives each worker a few runs of one kind at a time: the longest first, and so few of them that all workers finish at
/// about the same time. Thread-safe.
class RunQueue {
 public:
  /// `runs`: numbers of runs of the plan. `together`: for each kind of the plan, the most runs that are under way
  /// together in one batch.
  RunQueue(const Plan& plan, const std::vector<std::uint32_t>& runs, std::size_t workers,
           std::vector<std::size_t> together);

  /// The next runs, the longest that are left and others of its kind; none if all are taken.
  std::vector<std::uint32_t> take();

 private:
  static constexpr std::size_t most = 64;  // runs that a worker takes at a time

  /// The runs of a kind, the longest first.
  struct OfKind {
    std::vector<std::uint32_t> runs;
    std::size_t next = 0;
  };
  void wait(std::size_t kind);

  const Plan& plan_;
  std::vector<OfKind> kinds_;
  std::priority_queue<std::pair<double, std::size_t>> longest_;  // cost of each kind with runs left, and its number
  std::vector<std::size_t> together_;
  double cost_left_ = 0;
  double shares_ = 1;  // number of shares of the cost that is left; a worker takes one of them at a time
  std::mutex mutex_;
};

}  // namespace polhode::study::workers
