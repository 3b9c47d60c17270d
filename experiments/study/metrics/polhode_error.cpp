// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/polhode_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exact/exact_rotation.hpp"

namespace polhode::study::inline metrics {

std::optional<PolhodeError> PolhodeError::of(const System<double>& system, const FreeTop* top) {
  const auto& forces = system.forces();
  const bool torque =
      std::any_of(forces.begin(), forces.end(), [](const auto& force) { return force->effect_on(0).torque; });
  if (system.moving() != 1 || torque || system.has_joints()) return std::nullopt;
  const Matrix3<double>& inertia = system.problem().bodies[0].inertia;
  const Vector3<double> omega = start_omega_body(system.problem().starts[0]);
  PolhodeError error(inertia, omega, top ? *top : FreeTop(inertia, identity_quaternion<double>(), omega));
  if (error.top_.period() == 0) return std::nullopt;
  return error;
}

PolhodeError::PolhodeError(const Matrix3<double>& inertia, const Vector3<double>& omega_body, const FreeTop& top)
    : top_(top) {
  curve_.inertia = inertia;
  curve_.inverse_inertia = inertia.inverse();
  curve_.speed = omega_body.norm();
  curve_.size = (inertia * omega_body).norm();
  // ẏ = y × I⁻¹y and |y| = const give |y⁽ᵏ⁾|/k! ≤ |y| wᵏ with w = ‖I⁻¹‖ |y|, the series of ż = ‖I⁻¹‖ z². What the cubic
  // polynomial leaves out is below 1.0001e-16 |y| for w s = 1e-4.
  curve_.reach = 1e-4 / (curve_.inverse_inertia.norm() * curve_.size);
  // Near the separatrix the period is as long as many revolutions of the body, and needs more points.
  constexpr double points = 48, longest_step = 0.5 /* rad */, most_points = 4096;
  const double period = top_.period();
  const double count =
      std::isfinite(period) ? std::ceil(std::clamp(period * curve_.speed / longest_step, points, most_points)) : points;
  curve_.search_step = std::isfinite(period) ? period / count : longest_step / curve_.speed;
  points_ = static_cast<std::size_t>(count);
}

PolhodeError::Curve::Nearest PolhodeError::refined(double t, const Vector3<double>& y, double phase,
                                                   const Curve::Momentum& start) const {
  return curve_.refined(t, y, phase, start, true, [this](double at) { return top_.angular_velocity_body(at); });
}

/// Phase of the nearest point of the ring, within half a period of the expected phase.
double PolhodeError::nearest_of_ring(double t, const Vector3<double>& y, double expected) {
  for (std::size_t i = ring_.size(); i < points_; ++i) {
    ring_.push_back(exact(static_cast<double>(i) * curve_.search_step).y);
  }
  const auto size = static_cast<double>(points_);
  const double centre = std::round((t + expected) / curve_.search_step);
  double best = centre, least = std::numeric_limits<double>::infinity();
  for (double place = centre - std::floor(size / 2); place < centre + size / 2; ++place) {
    const double index = place - size * std::floor(place / size);
    const double distance = (y - ring_[static_cast<std::size_t>(index)]).squaredNorm();
    if (distance < least) {
      least = distance;
      best = place;
    }
  }
  return best * curve_.search_step - t;
}

/// The nearest point of the whole curve, where one that is not close was found next to the expected phase.
PolhodeError::Curve::Nearest PolhodeError::searched(double t, const Vector3<double>& y, double expected,
                                                    const Curve::Nearest& found) {
  const double other = nearest_of_ring(t, y, expected);
  const Curve::Momentum there = exact(t + other);
  return (y - there.y).norm() < found.distance ? refined(t, y, other, there) : found;
}

PolhodeError::At PolhodeError::at(double t, const BodySnapshot<double>& body,
                                  const std::optional<Vector3<double>>& exact_omega) {
  const Vector3<double> y = curve_.inertia * (body.rotation.transpose() * body.angular_velocity);
  if (!y.allFinite()) return {t, t, std::numeric_limits<double>::infinity()};
  const double expected = phase_ + phase_rate_ * (t - t_);
  const bool near = std::abs(expected) <= curve_.reach;
  const double from = near ? 0 : expected;
  const Curve::Momentum start = near && exact_omega ? curve_.momentum(*exact_omega) : exact(t + from);
  Curve::Nearest found = refined(t, y, from, start);
  if (!curve_.is_close(found)) found = searched(t, y, expected, found);
  if (t > t_) phase_rate_ = (found.phase - phase_) / (t - t_);
  t_ = t;
  phase_ = found.phase;
  return {phase_, curve_.speed * phase_, found.distance / curve_.size};
}

}  // namespace polhode::study::metrics
