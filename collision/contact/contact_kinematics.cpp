// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/contact_kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace polhode::inline collision::inline contact {

Vector3<double> relative_velocity(std::span<const ImpulseBody> bodies, const ImpulseContact& c) {
  return bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point);
}

std::span<ImpulseContact> ContactKinematics::touching(const State<double>& state) {
  shape_poses(system_, state.y, poses_);
  scene_.near_pairs(poses_, poses_, {}, lengths_.contact_tolerance + lengths_.allowed_penetration);
  impulse_bodies(system_, state.y, bodies_);
  const std::span<ImpulseContact> all =
      scene_.contacts(poses_, lengths_.contact_tolerance + lengths_.allowed_penetration);
  for (ImpulseContact& c : all) c.approach = relative_velocity(bodies_, c).dot(c.normal);
  return all;
}

void ContactKinematics::measure_accelerations(const State<double>& state) {
  rate_.setZero(state.y.size());
  system_.rate(state.t, state.y.data(), rate_.data());
  const double fast = rate_.cwiseAbs().maxCoeff();
  const double dt = fast > 0 ? 1e-7 / std::max(1.0, fast) : 1e-7;
  later_ = state.y + dt * rate_;
  impulse_bodies(system_, later_, rates_);
  for (std::size_t i = 0; i < rates_.size(); ++i) {
    rates_[i].velocity = (rates_[i].velocity - bodies_[i].velocity) / dt;
    rates_[i].angular_velocity = (rates_[i].angular_velocity - bodies_[i].angular_velocity) / dt;
  }
}

double ContactKinematics::normal_acceleration(const ImpulseContact& c) const {
  const auto of = [&](std::uint32_t i) -> Vector3<double> {
    const Vector3<double> arm = c.point - bodies_[i].position, &w = bodies_[i].angular_velocity;
    return rates_[i].velocity + rates_[i].angular_velocity.cross(arm) + w.cross(w.cross(arm));
  };
  return (of(c.a) - of(c.b)).dot(c.normal);
}

double ContactKinematics::resting_speed(const ImpulseContact& c) const {
  return speed_round_off + std::sqrt(2 * lengths_.minimum_bounce_height * std::max(-normal_acceleration(c), 0.0));
}

}  // namespace polhode::collision::contact
