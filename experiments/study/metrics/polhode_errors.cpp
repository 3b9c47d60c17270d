// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/polhode_errors.hpp"

#include <limits>

namespace polhode::study::inline metrics {

void PolhodeErrors::set(std::size_t lane, PolhodeError& one) {
  alone_[lane] = &one;
  const int i = int(lane);
  for (Eigen::Index k = 0; k < 9; ++k) {
    curve_.inertia.data()[k].set(i, one.curve_.inertia.data()[k]);
    curve_.inverse_inertia.data()[k].set(i, one.curve_.inverse_inertia.data()[k]);
  }
  curve_.speed.set(i, one.curve_.speed);
  curve_.size.set(i, one.curve_.size);
  curve_.reach.set(i, one.curve_.reach);
  curve_.search_step.set(i, one.curve_.search_step);
  take(lane);
}

void PolhodeErrors::give(std::size_t lane) const {
  PolhodeError& one = *alone_[lane];
  const int i = int(lane);
  one.t_ = t_[i];
  one.phase_ = phase_[i];
  one.phase_rate_ = phase_rate_[i];
}

void PolhodeErrors::take(std::size_t lane) {
  const PolhodeError& one = *alone_[lane];
  const int i = int(lane);
  t_.set(i, one.t_);
  phase_.set(i, one.phase_);
  phase_rate_.set(i, one.phase_rate_);
}

PolhodeErrors::At PolhodeErrors::at(Lanes t, const BodySnapshot<Lanes>& body, const FreeTops& tops,
                                    const Vector3<Lanes>& exact_omega, Lanes::Mask due) {
  const Vector3<Lanes> y = curve_.inertia * (body.rotation.transpose() * body.angular_velocity);
  constexpr double largest = std::numeric_limits<double>::max();
  const Lanes::Mask finite = (abs(y[0]) <= largest) & (abs(y[1]) <= largest) & (abs(y[2]) <= largest);
  const Lanes::Mask sought = due & finite;
  const Lanes expected = phase_ + phase_rate_ * (t - t_);
  const Lanes::Mask near = abs(expected) <= curve_.reach;
  const Lanes from = select(near, Lanes(0), expected);
  const auto exact = [&](Lanes at) { return tops.angular_velocity_body(at); };
  const Vector3<Lanes> omega = any(sought & !near) ? select(near, exact_omega, exact(t + from)) : exact_omega;
  PolhodeCurve<Lanes>::Nearest found = curve_.refined(t, y, from, curve_.momentum(omega), sought, exact);
  const Lanes::Mask far = sought & !curve_.is_close(found);
  for (int i = 0; i < lane_count && any(far); ++i) {
    if (!far.bits[i]) continue;
    PolhodeError& alone = *alone_[std::size_t(i)];
    const Vector3<double> y_alone(y[0][i], y[1][i], y[2][i]);
    const auto nearest = alone.searched(t[i], y_alone, expected[i], {found.phase[i], found.distance[i]});
    found.phase.set(i, nearest.phase);
    found.distance.set(i, nearest.distance);
  }
  phase_rate_ = select(sought & (t > t_), (found.phase - phase_) / (t - t_), phase_rate_);
  t_ = select(sought, t, t_);
  phase_ = select(sought, found.phase, phase_);
  return {select(finite, phase_, t), select(finite, curve_.speed * phase_, t),
          select(finite, found.distance / curve_.size, Lanes(std::numeric_limits<double>::infinity()))};
}

}  // namespace polhode::study::metrics
