// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/references.hpp"

#include "core/exact/exact_motion.hpp"

namespace polhode::study::inline metrics {

References::Key References::key(const RunConfig& config, const Scenario& scenario) {
  return {scenario.canonical, config.t_end};
}

void References::expect(const RunConfig& config, const Scenario& scenario) {
  const std::lock_guard lock(mutex_);
  auto& entry = entries_[key(config, scenario)];
  if (!entry) entry = std::make_shared<Entry>();
  ++entry->expected;
}

TrueMotion References::of(const RunConfig& config, const Scenario& scenario, const std::atomic<bool>* stop) {
  const Key which = key(config, scenario);
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard lock(mutex_);
    auto& found = entries_[which];
    if (!found) found = std::make_shared<Entry>();
    entry = found;
    if (entry->expected <= 1) entries_.erase(which);
    else --entry->expected;
  }
  const std::lock_guard lock(entry->making);
  if (!entry->scales) {
    MotionScales scales = motion_scales(scenario, config.t_end, stop);
    if (stop && *stop) return {};
    entry->scales = std::move(scales);
  }
  if (config.reference && !entry->reference && !ExactMotion(*make_system<double>(scenario.problem, {})).is_complete()) {
    auto made = std::make_shared<const ReferenceMotion>(scenario.problem, true, config.t_end, stop);
    if (stop && *stop) return {};
    entry->reference = std::move(made);
  }
  return {*entry->scales, config.reference ? entry->reference : nullptr};
}

}  // namespace polhode::study::metrics
