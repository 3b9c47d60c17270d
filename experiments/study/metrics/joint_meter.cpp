// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/joint_meter.hpp"

#include <algorithm>
#include <cmath>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "experiments/study/metrics/worst.hpp"

namespace polhode::study::inline metrics {
namespace {

constexpr std::int64_t instants = 1000, between_ranks = 10;
constexpr std::size_t most_ranked_rows = 200;  // a rank costs the cube of their number

}  // namespace

std::size_t JointMeter::on_samples(std::span<const Sample> samples) {
  if (!samples.empty()) {
    found_.work = samples.back().joint_work;
    found_.projection = samples.back().projection;
  }
  return samples.size();
}

double JointMeter::next_state() const {
  // Slightly early, so that a sample at the instant itself counts in spite of the rounding of its time.
  constexpr double early = 1 - 1e-12;
  return early * t_end_ * static_cast<double>(instant_) / static_cast<double>(instants);
}

void JointMeter::on_state(const State<double>& state, const Sample&) {
  const auto reached =
      static_cast<std::int64_t>(std::floor((1 + 1e-12) * state.t / t_end_ * static_cast<double>(instants)));
  if (reached < instant_ || !state.y.allFinite()) return;
  const Constraints<double>& constraints = *system_.constraints();
  const auto motions = motions_of(system_, state.y);
  for (std::size_t i = 0; i < constraints.count(); ++i) {
    const auto v = constraints.violation(i, motions);
    raise(found_.gap_max, v.position);
    raise(found_.velocity_max, v.velocity);
    if (!constraints.has_angles(i)) continue;
    raise(found_.angle_max, v.angle);
    raise(found_.rate_max, v.rate);
  }
  const bool due = instant_ == 0 || reached / between_ranks > (instant_ - 1) / between_ranks;
  if (due && constraints.rows() <= most_ranked_rows) {
    const ConstraintRank now = constraints.rank(motions);
    const auto rank = static_cast<double>(now.rank);
    found_.rank = std::min(found_.rank.value_or(rank), rank);
    raise(found_.condition_max, now.condition);
  }
  instant_ = reached + 1;
}

}  // namespace polhode::study::metrics
