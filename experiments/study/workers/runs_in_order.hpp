// SPDX-License-Identifier: BSD-3-Clause
// Finished runs in the order of the plan, while others are under way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "experiments/study/record/run_record.hpp"
#include "experiments/study/text/in_order.hpp"

namespace polhode::study::inline workers {

/// Number of runs of a part of a plan; the last part may have fewer.
inline constexpr std::size_t runs_of_a_part = 256;

/// Makes something of the runs of a part, on any thread, and returns how it is used in its turn.
using MakePart = std::function<UsePart(std::vector<RunRecord>&& runs)>;

/// The parts of a plan all of whose runs are carried out. A part is made once its runs are finished, and used once all
/// parts before it were. If runs finish in an order so different from that of the plan that more than `most_waiting`
/// wait for others, the parts that were not used are forgotten, and no further one is made. Thread-safe.
class RunsInOrder {
 public:
  static constexpr std::size_t most_waiting = 8192;

  /// `runs`: number of runs of the plan.
  RunsInOrder(std::size_t runs, MakePart make) : runs_(runs), make_(std::move(make)) {}

  /// Takes over finished runs with these numbers in the plan.
  void add(std::span<const std::uint32_t> numbers, std::span<RunRecord> records);
  /// Makes a part whose runs are finished, if there is one, and uses the parts whose turn has come.
  void work();
  /// Number of parts that were used, which are the first ones of the plan.
  std::size_t used() const;

 private:
  struct Part {
    std::vector<RunRecord> runs;
    std::size_t finished = 0;
  };

  void use_made(std::unique_lock<std::mutex>& lock);
  bool ends_early();

  std::size_t runs_;
  MakePart make_;
  mutable std::mutex mutex_;
  std::map<std::size_t, Part> begun_;     ///< parts with some of their runs, by number
  std::map<std::size_t, Part> finished_;  ///< parts with all of them
  std::map<std::size_t, UsePart> made_;
  std::size_t waiting_ = 0;  ///< number of runs in these three
  std::size_t next_ = 0;     ///< part whose turn it is
  bool in_use_ = false;      ///< a thread uses parts
  bool ended_ = false;
};

}  // namespace polhode::study::workers
