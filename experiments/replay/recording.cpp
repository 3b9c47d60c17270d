// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/recording.hpp"

#include <algorithm>
#include <numeric>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::replay {

std::vector<std::pair<std::string, std::string>> facts_of(const RunConfig& config, Roles without) {
  std::vector<std::string> keys;
  for (const Override& o : config.varied) keys.push_back(o.key);
  const NamedOptions all = options_on_demand();
  const auto columns = config_columns(keys, all, without), cells = config_cells(config, all, without);
  std::vector<std::pair<std::string, std::string>> facts;
  for (std::size_t k = 0; k < columns.size(); ++k) facts.emplace_back(columns[k], cells[k]);
  return facts;
}

std::string label_of(const Recording& r) {
  const RunConfig& run = r.config;
  if (run.tolerance) return run.integrator + ", tolerance " + rounded(*run.tolerance);
  return run.dt ? run.integrator + ", dt = " + rounded(*run.dt) + " s" : run.integrator;
}

ShownMomentum shown_momentum(const System<double>& system, const Scenario& scenario) {
  const auto& bodies = scenario.problem.bodies;
  for (std::size_t i = 0; i < scenario.colliders.size(); ++i) {
    if (scenario.colliders[i].shape && bodies[i].fixed) return ShownMomentum::none;
  }
  const ConservedMomenta conserved = conserved_momenta(system);
  return conserved.angular ? ShownMomentum::angular : conserved.linear ? ShownMomentum::linear : ShownMomentum::none;
}

void keep_these(Recording& recording, std::span<const std::size_t> instants) {
  const auto keep = [&](auto& all, std::size_t each) {
    for (std::size_t i = 0; i < instants.size(); ++i)
      std::copy_n(all.begin() + std::ptrdiff_t(instants[i] * each), each, all.begin() + std::ptrdiff_t(i * each));
    all.resize(instants.size() * each);
  };
  keep(recording.times, 1);
  keep(recording.energy_drift, 1);
  keep(recording.momentum_drift, 1);
  keep(recording.placements, recording.moving);
  keep(recording.reactions, recording.joints);
}

void keep_instants(Recording& recording, std::size_t n) {
  const std::size_t all = recording.times.size();
  if (all <= n) return;
  std::vector<std::size_t> instants(n);
  for (std::size_t i = 0; i < n; ++i) instants[i] = (i * (all - 1) + (n - 1) / 2) / (n - 1);
  keep_these(recording, instants);
}

void keep_impacts(Recording& recording, std::size_t n) {
  auto& impacts = recording.impacts;
  if (impacts.size() <= n) return;
  std::vector<std::size_t> order(impacts.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return impacts[a].impulse.squaredNorm() > impacts[b].impulse.squaredNorm();
  });
  order.resize(n);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < n; ++i) impacts[i] = impacts[order[i]];
  impacts.resize(n);
}

double longest_spacing(const Recording& recording) {
  double longest = 0;
  for (std::size_t k = 1; k < recording.times.size(); ++k) {
    longest = std::max(longest, recording.times[k] - recording.times[k - 1]);
  }
  return longest;
}

double largest_turn(const Recording& recording) {
  double largest = 0;
  for (std::size_t k = 1; k < recording.times.size(); ++k) {
    const double spacing = recording.times[k] - recording.times[k - 1];
    for (std::size_t i = 0; i < recording.moving; ++i) {
      const double a = recording.placements[(k - 1) * recording.moving + i].angular_velocity.norm();
      const double b = recording.placements[k * recording.moving + i].angular_velocity.norm();
      largest = std::max(largest, std::max(a, b) * spacing);
    }
  }
  return largest;
}

}  // namespace polhode::study::replay
