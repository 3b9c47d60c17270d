// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/lane_errors.hpp"

#include <utility>

namespace polhode::study::inline metrics {
namespace {

/// Raises the worst to this size, or to NaN if that is NaN, where it was measured.
void raise(Lanes& worst, Lanes size, Lanes::Mask measured) { worst = select(measured & !(size <= worst), size, worst); }

}  // namespace

void LaneErrors::begin(std::size_t lane, DriftMeter& meter) {
  const FreeTop* top = meter.polhode_ ? meter.exact_.free_top(0) : nullptr;
  const ExactMotion::Error& start = meter.worst_error_;
  meters_[lane] = nullptr;
  if (!top || meter.follower_ || meter.measures_invariants() || !start.attitude || !start.angular_velocity) return;
  meters_[lane] = &meter;
  const int i = int(lane);
  for (int k = 0; k < lane_count; ++k) {  // the first top serves lanes that have none yet
    if (k != i && any_before_) continue;
    tops_.set(k, *top);
    polhode_.set(std::size_t(k), *meter.polhode_);
  }
  any_before_ = true;
  speed_scale_.set(i, meter.exact_.speed_scale());
  take(lane);
}

void LaneErrors::take(std::size_t lane) {
  const DriftMeter& meter = *meters_[lane];
  const int i = int(lane);
  const ExactMotion::Error& worst = meter.worst_error_;
  position_.set(i, worst.position.value_or(0));
  attitude_.set(i, *worst.attitude);
  angular_velocity_.set(i, *worst.angular_velocity);
  phase_.set(i, meter.worst_polhode_.phase);
  phase_rad_.set(i, meter.worst_polhode_.phase_rad);
  off_.set(i, meter.worst_polhode_.off);
  polhode_.take(lane);
  alone_[lane] = false;
}

void LaneErrors::give(std::size_t lane) {
  if (std::exchange(alone_[lane], true)) return;
  DriftMeter& meter = *meters_[lane];
  const int i = int(lane);
  ExactMotion::Error& worst = meter.worst_error_;
  if (worst.position) worst.position = position_[i];
  worst.attitude = attitude_[i];
  worst.angular_velocity = angular_velocity_[i];
  meter.worst_polhode_ = {phase_[i], phase_rad_[i], off_[i]};
  polhode_.give(lane);
}

void LaneErrors::measure(const LaneStates& states, std::span<bool> due) {
  Lanes::Mask here(false);
  int due_here = 0;
  for (std::size_t i = 0; i < count; ++i) {
    here.bits[i] = due[i] && meters_[i] ? -1 : 0;
    due_here += here.bits[i] ? 1 : 0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!here.bits[i]) continue;
    if (due_here < fewest) give(i);
    else if (alone_[i]) take(i);
  }
  if (due_here < fewest) return;
  const Lanes t = states.sample.t;
  const BodySnapshot<Lanes> body = states.system.snapshot(states.y, 0);
  const TopAt<Lanes> exact = tops_.at(t);
  const Vector3<Lanes> omega = rotation_matrix(exact.orientation) * exact.angular_velocity_body;
  const Lanes attitude = angle_between(body.orientation, exact.orientation);
  raise(attitude_, attitude, here);
  raise(angular_velocity_, (body.angular_velocity - omega).norm() / speed_scale_, here);
  const PolhodeErrors::At polhode = polhode_.at(t, body, tops_, exact.angular_velocity_body, here);
  raise(phase_, abs(polhode.phase), here);
  raise(phase_rad_, abs(polhode.phase_rad), here);
  raise(off_, abs(polhode.off), here);
  Vector3<Lanes> position = body.position;
  for (std::size_t i = 0; i < count; ++i) {
    if (!here.bits[i]) continue;
    due[i] = false;
    DriftMeter& meter = *meters_[i];
    const int lane = int(i);
    if (const ExactPath& path = meter.exact_.path(0)) {
      const PathAt at = path(t[lane]);
      for (int k = 0; k < 3; ++k) position[k].set(lane, at.position[k]);
    }
    meter.errors_until_ = t[lane];
    meter.keep_attitude_error(t[lane], attitude[lane]);
    meter.plan_next_errors(t[lane]);
  }
  raise(position_, (body.position - position).norm(), here);
}

void LaneErrors::end(std::size_t lane) {
  if (!meters_[lane]) return;
  give(lane);
  meters_[lane] = nullptr;
}

}  // namespace polhode::study::metrics
