// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/polhode_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::study {

std::optional<PolhodeError> PolhodeError::of(const System<double>& system) {
  const auto& forces = system.forces();
  const bool torque =
      std::any_of(forces.begin(), forces.end(), [](const auto& force) { return force->effect_on(0).torque; });
  if (system.moving() != 1 || torque) return std::nullopt;
  const BodySnapshot<double> body = system.snapshot(system.start().y, 0);
  PolhodeError error(system.problem().bodies[0].inertia, body.rotation.transpose() * body.angular_velocity);
  if (error.top_.period() == 0) return std::nullopt;
  return error;
}

PolhodeError::PolhodeError(const Matrix3<double>& inertia, const Vector3<double>& omega_body)
    : inertia_(inertia),
      top_(inertia, identity_quaternion<double>(), omega_body),
      speed_(omega_body.norm()),
      size_((inertia * omega_body).norm()) {
  // Near the separatrix the period is many turns long, and the phase of an instant a small part of it.
  constexpr double points = 48, longest_step = 0.5;  // rad
  search_step_ = std::min(top_.period() / points, longest_step / speed_);
  window_ = search_step_ * points / 2;
}

PolhodeError::Momentum PolhodeError::exact(double t) const {
  const Vector3<double> omega = top_.angular_velocity_body(t), y = inertia_ * omega;
  return {y, y.cross(omega)};
}

/// Gauss and Newton's way to the nearest point, in steps that do not leave its neighbourhood.
double PolhodeError::refined(double t, const Vector3<double>& y, double phase) const {
  constexpr int most_steps = 30;
  double best = phase, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    const Momentum m = exact(t + phase);
    const double distance = (y - m.value).squaredNorm(), rate2 = m.rate.squaredNorm();
    if (distance < least) {
      least = distance;
      best = phase;
    }
    if (!(rate2 > 0)) break;
    const double step = std::clamp((y - m.value).dot(m.rate) / rate2, -search_step_, search_step_);
    phase += step;
    if (!(std::abs(step) > std::numeric_limits<double>::epsilon() * (std::abs(t) + std::abs(phase)))) break;
  }
  return best;
}

PolhodeError::At PolhodeError::at(double t, const BodySnapshot<double>& body) {
  const Vector3<double> y = inertia_ * (body.rotation.transpose() * body.angular_velocity);
  if (!y.allFinite()) return {t, t, std::numeric_limits<double>::infinity()};
  const double expected = phase_ + phase_rate_ * (t - t_);
  double phase = refined(t, y, expected), least = (y - exact(t + phase).value).squaredNorm();
  // Close to the curve, the point that is nearest to the expected one is the nearest.
  constexpr double close = 0.02;
  if (!(least <= close * close * size_ * size_)) {
    double start = phase;
    for (double other = expected - window_; other < expected + window_; other += search_step_) {
      const double distance = (y - exact(t + other).value).squaredNorm();
      if (distance < least) {
        least = distance;
        start = other;
      }
    }
    phase = refined(t, y, start);
  }
  if (t > t_) phase_rate_ = (phase - phase_) / (t - t_);
  t_ = t;
  phase_ = phase;
  return {phase, speed_ * phase, (y - exact(t + phase).value).norm() / size_};
}

}  // namespace polhode::study
