// SPDX-License-Identifier: BSD-3-Clause
// The order in which workers take the runs of a plan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "experiments/study/plan/plan.hpp"

namespace polhode::study {

/// Gives each worker a few neighbouring runs at a time: the longest first, and so few of them that all workers finish
/// at about the same time. Thread-safe.
class RunQueue {
 public:
  /// `runs`: numbers of runs of the plan. `together`: for each kind of the plan, the most runs that are carried out
  /// together.
  RunQueue(const Plan& plan, std::vector<std::uint32_t> runs, std::size_t workers, std::vector<std::size_t> together);

  /// The next runs; none if all are taken.
  std::vector<std::uint32_t> take();

 private:
  static constexpr std::size_t most = 64;  // runs that a worker takes at a time

  const Plan& plan_;
  std::vector<std::uint32_t> runs_;
  std::vector<std::size_t> together_;
  double cost_left_ = 0;
  std::size_t next_ = 0;
  double shares_ = 1;  // of the cost that is left; a worker takes one of them at a time
  std::mutex mutex_;
};

}  // namespace polhode::study
