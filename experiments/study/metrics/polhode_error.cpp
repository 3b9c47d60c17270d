// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/polhode_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::study::inline metrics {

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
      inverse_inertia_(inertia.inverse()),
      top_(inertia, identity_quaternion<double>(), omega_body),
      speed_(omega_body.norm()),
      size_((inertia * omega_body).norm()) {
  // Near the separatrix the period is as long as many revolutions of the body, and needs more points.
  constexpr double points = 48, longest_step = 0.5 /* rad */, most_points = 4096;
  const double period = top_.period();
  const double count =
      std::isfinite(period) ? std::ceil(std::clamp(period * speed_ / longest_step, points, most_points)) : points;
  search_step_ = std::isfinite(period) ? period / count : longest_step / speed_;
  points_ = static_cast<std::size_t>(count);
}

PolhodeError::Momentum PolhodeError::exact(double t) const {
  const Vector3<double> omega = top_.angular_velocity_body(t), y = inertia_ * omega;
  const Vector3<double> rate = y.cross(omega);
  return {y, rate, rate.cross(omega) + y.cross(inverse_inertia_ * rate)};
}

/// The nearest point by Newton's method from `phase`, with steps of at most search_step_; by the Gauss–Newton
/// method where the squared distance is not sufficiently convex.
PolhodeError::Nearest PolhodeError::refined(double t, const Vector3<double>& y, double phase) const {
  constexpr int most_steps = 30;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  Nearest best{phase, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < most_steps; ++i) {
    const Momentum m = exact(t + phase);
    const Vector3<double> off = y - m.value;
    const double distance = off.squaredNorm(), rate2 = m.rate.squaredNorm();
    if (distance < best.distance2) best = {phase, distance};
    if (!(rate2 > 0)) break;
    const double curvature = rate2 - off.dot(m.second);
    const double step =
        std::clamp(off.dot(m.rate) / (4 * curvature > rate2 ? curvature : rate2), -search_step_, search_step_);
    phase += step;
    if (!(std::abs(step) > rounding * (std::abs(t) + std::abs(phase) + size_ / std::sqrt(rate2)))) break;
  }
  return best;
}

/// Phase of the nearest point of the ring, within half a period of the expected phase.
double PolhodeError::nearest_of_ring(double t, const Vector3<double>& y, double expected) {
  for (std::size_t i = ring_.size(); i < points_; ++i) {
    ring_.push_back(exact(static_cast<double>(i) * search_step_).value);
  }
  const auto size = static_cast<double>(points_);
  const double centre = std::round((t + expected) / search_step_);
  double best = centre, least = std::numeric_limits<double>::infinity();
  for (double place = centre - std::floor(size / 2); place < centre + size / 2; ++place) {
    const double index = place - size * std::floor(place / size);
    const double distance = (y - ring_[static_cast<std::size_t>(index)]).squaredNorm();
    if (distance < least) {
      least = distance;
      best = place;
    }
  }
  return best * search_step_ - t;
}

PolhodeError::At PolhodeError::at(double t, const BodySnapshot<double>& body) {
  const Vector3<double> y = inertia_ * (body.rotation.transpose() * body.angular_velocity);
  if (!y.allFinite()) return {t, t, std::numeric_limits<double>::infinity()};
  const double expected = phase_ + phase_rate_ * (t - t_);
  Nearest found = refined(t, y, expected);
  // If y is close to the curve, the minimum next to the expected phase is the global one.
  constexpr double close = 0.02;
  if (!(found.distance2 <= close * close * size_ * size_)) {
    const double other = nearest_of_ring(t, y, expected);
    if ((y - exact(t + other).value).squaredNorm() < found.distance2) found = refined(t, y, other);
  }
  if (t > t_) phase_rate_ = (found.phase - phase_) / (t - t_);
  t_ = t;
  phase_ = found.phase;
  return {phase_, speed_ * phase_, std::sqrt(found.distance2) / size_};
}

}  // namespace polhode::study::metrics
