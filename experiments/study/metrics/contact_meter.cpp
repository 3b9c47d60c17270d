// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/contact_meter.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/study/metrics/worst.hpp"

namespace polhode::study::inline metrics {
namespace {

constexpr std::int64_t depth_instants = 1000, between_depths = 10;
constexpr double settled_at = 2;  // time from which displacements are measured, s
constexpr double left = 0.1;  // displacement from the start, over the body's radius, beyond which it has left its place

}  // namespace

ContactMeter::ContactMeter(const System<double>& system, const Scenario& scenario, const ContactConfig& config,
                           double t_end)
    : system_(system),
      scene_(scenario.problem, scenario.colliders, config.broad_phase, config.narrow_phase),
      t_end_(t_end) {}

void ContactMeter::on_start(const State<double>& state, const Sample& sample) {
  energy_start_ = energy_least_ = sample.seen.energy() - sample.work;
  on_state(state, sample);
}

std::size_t ContactMeter::on_samples(std::span<const Sample> samples) {
  for (const Sample& sample : samples) {
    const double energy = sample.seen.energy() - sample.work;
    energy_least_ = std::min(energy_least_, energy);
    raise(found_.energy_rise_max, energy - energy_least_);
    raise(found_.energy_change_max, std::abs(energy - energy_start_));
  }
  return samples.size();
}

void ContactMeter::on_impacts(std::span<const Impact> impacts) {
  if (!found_.first_impact && !impacts.empty()) found_.first_impact = impacts.front().t;
}

void ContactMeter::on_contact_energy(const ContactLosses& losses) {
  found_.impact_loss = losses.impact;
  found_.friction_loss = losses.friction;
  found_.penetration_energy = losses.penetration;
}

double ContactMeter::next_state() const {
  // Slightly early, so that a sample at the instant itself counts in spite of the rounding of its time.
  constexpr double early = 1 - 1e-12;
  return early * t_end_ * static_cast<double>(instant_) / depth_instants;
}

void ContactMeter::on_state(const State<double>& state, const Sample&) {
  const auto reached = static_cast<std::int64_t>(std::floor((1 + 1e-12) * state.t / t_end_ * depth_instants));
  if (reached < instant_) return;
  shape_poses(system_, state.y, poses_);
  measure_places(state);
  // Depths are measured at the first instant at or after each tenth one.
  if (instant_ == 0 || reached / between_depths > (instant_ - 1) / between_depths) measure_depth(state);
  instant_ = reached + 1;
}

void ContactMeter::measure_depth(const State<double>& state) {
  if (!state.y.allFinite()) return;
  scene_.near_pairs(poses_, poses_, {}, 0);
  double deepest = 0;
  for (const ImpulseContact& c : scene_.contacts(poses_, 0)) deepest = std::max(deepest, c.depth);
  raise(found_.penetration_max, deepest);
  found_.penetration_end = deepest;
}

void ContactMeter::measure_places(const State<double>& state) {
  if (started_.empty()) started_ = poses_;
  if (settled_.empty() && state.t >= settled_at * (1 - 1e-12)) settled_ = poses_;
  for (std::size_t i = 0; i < system_.moving(); ++i) {
    const double moved = (poses_[i].position - started_[i].position).norm();
    if (!found_.left_place && moved > left * scene_.radius(i) && scene_.radius(i) > 0) found_.left_place = state.t;
    if (!settled_.empty()) raise(found_.displacement_max, (poses_[i].position - settled_[i].position).norm());
  }
}

void ContactMeter::report(RunResult& result) const { result.contact = found_; }

}  // namespace polhode::study::metrics
