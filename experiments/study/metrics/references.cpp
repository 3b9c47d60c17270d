// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/references.hpp"

#include <algorithm>

#include "core/exact/exact_motion.hpp"

namespace polhode::study::inline metrics {

namespace {

constexpr std::size_t most_kept = 20'000;

}  // namespace

void References::expect(std::vector<std::uint64_t> scenarios) {
  std::sort(scenarios.begin(), scenarios.end());
  const std::lock_guard lock(mutex_);
  for (auto at = scenarios.begin(); at != scenarios.end();) {
    const auto end = std::upper_bound(at, scenarios.end(), *at);
    if (end - at > 1) shared_[*at].expected += static_cast<std::size_t>(end - at);
    at = end;
  }
}

std::shared_ptr<References::Motion> References::motion_of(const Scenario& scenario, double t_end) {
  std::unique_lock lock(mutex_);
  if (shared_.empty()) return std::make_shared<Motion>();
  lock.unlock();
  const std::uint64_t number = number_of(scenario);
  lock.lock();
  const auto found = shared_.find(number);
  if (found == shared_.end()) return std::make_shared<Motion>();
  Shared& shared = found->second;
  std::shared_ptr<Motion> motion;
  if (const auto known = shared.motions.find(t_end); known != shared.motions.end()) motion = known->second;
  if (!motion) {
    motion = std::make_shared<Motion>();
    if (kept_ < most_kept) {
      shared.motions[t_end] = motion;
      ++kept_;
    }
  }
  if (--shared.expected == 0) {
    kept_ -= shared.motions.size();
    shared_.erase(found);
  }
  return motion;
}

TrueMotion References::of(const RunConfig& config, const Scenario& scenario, const std::atomic<bool>* stop) {
  const std::shared_ptr<Motion> entry = motion_of(scenario, config.t_end);
  const std::lock_guard lock(entry->making);
  if (!entry->scales) {
    MotionScales scales = motion_scales(scenario, config.t_end, stop);
    if (stop && *stop) return {std::move(scales), nullptr};
    entry->scales = std::move(scales);
  }
  if (config.reference && !entry->reference && !ExactMotion(*make_system<double>(scenario.problem, {})).is_complete()) {
    auto made = std::make_shared<const ReferenceMotion>(scenario.problem, true, config.t_end, stop);
    if (stop && *stop) return {*entry->scales, nullptr};
    entry->reference = std::move(made);
  }
  return {*entry->scales, config.reference ? entry->reference : nullptr};
}

void References::assume(const Scenario& scenario, double t_end, MotionScales scales) {
  const std::shared_ptr<Motion> entry = motion_of(scenario, t_end);
  const std::lock_guard lock(entry->making);
  entry->scales = std::move(scales);
}

}  // namespace polhode::study::metrics
