// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/runs_in_order.hpp"

#include <algorithm>
#include <utility>

namespace polhode::study::inline workers {

void RunsInOrder::add(std::span<const std::uint32_t> numbers, std::span<RunRecord> records) {
  const std::lock_guard lock(mutex_);
  for (std::size_t k = 0; k < numbers.size() && !ended_; ++k) {
    const std::size_t number = numbers[k] / runs_of_a_part, first = number * runs_of_a_part;
    Part& part = begun_[number];
    if (part.runs.empty()) part.runs.resize(std::min(runs_of_a_part, runs_ - first));
    part.runs[numbers[k] - first] = std::move(records[k]);
    ++waiting_;
    if (++part.finished == part.runs.size()) finished_.insert(begun_.extract(number));
    ended_ = ends_early();
  }
}

void RunsInOrder::work() {
  std::unique_lock lock(mutex_);
  if (finished_.empty()) return;
  auto part = finished_.extract(finished_.begin());
  lock.unlock();
  UsePart use = make_(std::move(part.mapped().runs));
  lock.lock();
  if (ended_) return;
  made_.emplace(part.key(), std::move(use));
  if (!in_use_) use_made(lock);
}

std::size_t RunsInOrder::used() const {
  const std::lock_guard lock(mutex_);
  return next_;
}

void RunsInOrder::use_made(std::unique_lock<std::mutex>& lock) {
  in_use_ = true;
  while (!made_.empty() && made_.begin()->first == next_) {
    const auto part = made_.extract(made_.begin());
    lock.unlock();
    part.mapped()();
    lock.lock();
    waiting_ -= std::min(waiting_, runs_of_a_part);
    ++next_;
  }
  in_use_ = false;
}

/// Forgets all parts if too many runs wait. Returns true if so.
bool RunsInOrder::ends_early() {
  if (waiting_ <= most_waiting) return false;
  begun_.clear();
  finished_.clear();
  made_.clear();
  return true;
}

}  // namespace polhode::study::workers
