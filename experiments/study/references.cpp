// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/references.hpp"

namespace polhode::study {
namespace {

bool known_in_full(const System<double>& system) {
  const ExactMotion exact(system);
  bool any_path = false;
  for (std::size_t i = 0; i < system.moving(); ++i) any_path = any_path || !system.problem().bodies[i].pinned;
  return exact.has_attitude() && (exact.has_position() || !any_path);
}

}  // namespace

References::Key References::key(const RunConfig& config, const Scenario& scenario) {
  return {scenario.canonical, config.t_end};
}

void References::expect(const RunConfig& config, const Scenario& scenario) {
  if (!config.reference) return;
  const std::lock_guard lock(mutex_);
  auto& entry = entries_[key(config, scenario)];
  if (!entry) entry = std::make_shared<Entry>();
  ++entry->expected;
}

std::shared_ptr<const ReferenceMotion> References::of(const RunConfig& config, const Scenario& scenario,
                                                      const System<double>& system, const std::atomic<bool>* stop) {
  if (!config.reference) return nullptr;
  const Key which = key(config, scenario);
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard lock(mutex_);
    auto& found = entries_[which];
    if (!found) found = std::make_shared<Entry>();
    entry = found;
    if (entry->expected <= 1)
      entries_.erase(which);
    else
      --entry->expected;
  }
  if (known_in_full(system)) return nullptr;
  const std::lock_guard lock(entry->making);
  if (!entry->made) {
    auto made = std::make_shared<const ReferenceMotion>(system.problem(), true, config.t_end, stop);
    if (stop && *stop) return nullptr;
    entry->made = std::move(made);
  }
  return entry->made;
}

}  // namespace polhode::study
