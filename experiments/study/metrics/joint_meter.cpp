// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/joint_meter.hpp"

#include <algorithm>
#include <cmath>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "core/system/joint_reactions.hpp"
#include "experiments/study/metrics/worst.hpp"

namespace polhode::study::inline metrics {
namespace {

constexpr std::int64_t instants = 1000, between_ranks = 10, between_errors = 20;
constexpr std::size_t most_ranked_rows = 200;  // a rank costs the cube of their number

}  // namespace

JointMeter::JointMeter(const System<double>& system, double t_end, std::shared_ptr<const ReferenceMotion> reference)
    : system_(system), t_end_(t_end) {
  if (reference) {
    follower_.emplace(std::move(reference));
    return;
  }
  exact_.emplace(system);
  if (!exact_->is_complete() || !exact_->has_angular_velocity()) exact_.reset();
}

void JointMeter::on_multipliers(std::span<const double> multipliers) {
  multipliers_ = Eigen::Map<const VectorX<double>>(multipliers.data(), Eigen::Index(multipliers.size()));
}

std::size_t JointMeter::on_samples(std::span<const Sample> samples) {
  if (!samples.empty()) {
    found_.work = samples.back().joint_work;
    found_.projection = samples.back().projection;
  }
  return samples.size();
}

double JointMeter::time_of(std::int64_t instant) const {
  // Slightly early, so that a sample at the instant itself counts in spite of the rounding of its time.
  constexpr double early = 1 - 1e-12;
  return early * t_end_ * static_cast<double>(instant) / static_cast<double>(instants);
}

std::int64_t JointMeter::reached(double t) const {
  return static_cast<std::int64_t>(std::floor((1 + 1e-12) * t / t_end_ * static_cast<double>(instants)));
}

void JointMeter::on_state(const State<double>& state, const Sample&) {
  const std::int64_t now = reached(state.t);
  if (now < instant_ || !state.y.allFinite()) return;
  const auto motions = motions_of(system_, state.y);
  measure_gaps(motions, {found_.gap_max, found_.angle_max, found_.velocity_max, found_.rate_max});
  const auto due = [&](std::int64_t between) { return instant_ == 0 || now / between > (instant_ - 1) / between; };
  if (due(between_ranks)) measure_rank(motions);
  if (due(between_errors)) measure_errors(state);
  instant_ = now + 1;
}

void JointMeter::on_state_within_step(const State<double>& state) {
  if (!state.y.allFinite()) return;
  measure_gaps(motions_of(system_, state.y),
               {found_.gap_within, found_.angle_within, found_.velocity_within, found_.rate_within});
  instant_within_ = std::max(instant_within_, reached(state.t) + 1);
}

void JointMeter::measure_gaps(std::span<const BodyMotion<double>> motions, const Opening& to) const {
  const Constraints<double>& constraints = *system_.constraints();
  for (std::size_t i = 0; i < constraints.count(); ++i) {
    const auto v = constraints.violation(i, motions);
    raise(to.gap, v.position);
    raise(to.velocity, v.velocity);
    if (!constraints.has_angles(i)) continue;
    raise(to.angle, v.angle);
    raise(to.rate, v.rate);
  }
}

void JointMeter::measure_rank(std::span<const BodyMotion<double>> motions) {
  const Constraints<double>& constraints = *system_.constraints();
  if (constraints.rows() > most_ranked_rows) return;
  const ConstraintRank now = constraints.rank(motions);
  const auto rank = static_cast<double>(now.rank);
  found_.rank = std::min(found_.rank.value_or(rank), rank);
  raise(found_.condition_max, now.condition);
}

void JointMeter::measure_errors(const State<double>& state) {
  if (follower_) compare(state, follower_->system(), follower_->at(state.t));
  else if (exact_) compare(state, system_, exact_->state(system_, state));
}

template <class S>
void JointMeter::compare(const State<double>& state, const System<S>& system, const VectorX<S>& exact) {
  for (std::size_t i = 0; i < system_.moving(); ++i) {
    const Vector3<S> v = system_.snapshot(state.y, i).velocity.template cast<S>();
    raise(found_.speed_error_max, static_cast<double>((v - system.snapshot(exact, i).velocity).norm()));
  }
  const auto found = joint_reactions(system_, state.t, state.y, multipliers_);
  const auto right = joint_reactions(system, S(state.t), exact);
  for (std::size_t i = 0; i < found.size(); ++i) {
    raise(found_.reaction_error_max, static_cast<double>((found[i].force.template cast<S>() - right[i].force).norm()));
    if (!system_.constraints()->has_angles(i)) continue;
    raise(found_.reaction_torque_error_max,
          static_cast<double>((found[i].torque.template cast<S>() - right[i].torque).norm()));
  }
}

}  // namespace polhode::study::metrics
