// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/polhode_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exact/exact_rotation.hpp"

namespace polhode::study::inline metrics {

std::optional<PolhodeError> PolhodeError::of(const System<double>& system) {
  const auto& forces = system.forces();
  const bool torque =
      std::any_of(forces.begin(), forces.end(), [](const auto& force) { return force->effect_on(0).torque; });
  if (system.moving() != 1 || torque || system.has_joints()) return std::nullopt;
  PolhodeError error(system.problem().bodies[0].inertia, start_omega_body(system.problem().starts[0]));
  if (error.top_.period() == 0) return std::nullopt;
  return error;
}

PolhodeError::PolhodeError(const Matrix3<double>& inertia, const Vector3<double>& omega_body)
    : inertia_(inertia),
      inverse_inertia_(inertia.inverse()),
      top_(inertia, identity_quaternion<double>(), omega_body),
      speed_(omega_body.norm()),
      size_((inertia * omega_body).norm()) {
  // ẏ = y × I⁻¹y and |y| = const give |y⁽ᵏ⁾|/k! ≤ |y| wᵏ with w = ‖I⁻¹‖ |y|, the series of ż = ‖I⁻¹‖ z². What the cubic
  // polynomial leaves out is below 1.0001e-16 |y| for w s = 1e-4.
  reach_ = 1e-4 / (inverse_inertia_.norm() * size_);
  // Near the separatrix the period is as long as many revolutions of the body, and needs more points.
  constexpr double points = 48, longest_step = 0.5 /* rad */, most_points = 4096;
  const double period = top_.period();
  const double count =
      std::isfinite(period) ? std::ceil(std::clamp(period * speed_ / longest_step, points, most_points)) : points;
  search_step_ = std::isfinite(period) ? period / count : longest_step / speed_;
  points_ = static_cast<std::size_t>(count);
}

PolhodeError::Momentum PolhodeError::exact(double t) const {
  const Vector3<double> omega = top_.angular_velocity_body(t);
  return {inertia_ * omega, omega};
}

/// The derivatives of ẏ = y × ω.
PolhodeError::Derivatives PolhodeError::derivatives(const Momentum& m) const {
  const Vector3<double> rate = m.rate(), omega_rate = inverse_inertia_ * rate;
  const Vector3<double> second = rate.cross(m.omega) + m.y.cross(omega_rate);
  const Vector3<double> omega_second = inverse_inertia_ * second;
  return {rate, second, second.cross(m.omega) + 2 * rate.cross(omega_rate) + m.y.cross(omega_second)};
}

/// The nearest point from `start`, the exact momentum at t + phase, by Chebyshev's method. With g half the squared
/// distance and n = −g'/g" Newton's step, its step is n − n² g"'/2g", whose error is of third order (Traub, Iterative
/// Methods for the Solution of Equations, 1964). Where that correction is large the step is Newton's, and where g is
/// not sufficiently convex that of the Gauss–Newton method. Steps are at most search_step_. Within reach_ of the last
/// elliptic functions y is their Taylor polynomial, so that a further step costs no others.
PolhodeError::Nearest PolhodeError::refined(double t, const Vector3<double>& y, double phase, Momentum start) const {
  constexpr int most_steps = 30;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  Nearest best{phase, std::numeric_limits<double>::infinity()};
  Momentum m = start;
  Derivatives of_start;
  double start_phase = phase;
  for (int i = 0; i < most_steps; ++i) {
    const Vector3<double> off = y - m.y, rate = m.rate();
    const double distance = off.norm(), rate2 = rate.squaredNorm(), along = off.dot(rate);
    // Where distances do not differ but for round-off, the later point is the nearer one.
    if (distance <= best.distance + 4 * rounding * size_) best = {phase, distance};
    if (!(std::abs(along) > rounding * ((std::abs(t) + std::abs(phase)) * rate2 + size_ * std::sqrt(rate2)))) break;
    const Derivatives d = derivatives(m);
    if (phase == start_phase) of_start = d;
    const double curvature = rate2 - off.dot(d.second);
    double step = along / rate2;
    if (4 * curvature > rate2) {
      step = along / curvature;
      const double correction = step * (3 * rate.dot(d.second) - off.dot(d.third)) / (2 * curvature);
      if (std::abs(correction) < 0.25) step -= step * correction;
    }
    phase += std::clamp(step, -search_step_, search_step_);
    const double s = phase - start_phase;
    if (std::abs(s) <= reach_) {
      m.y = start.y + s * (of_start.rate + s / 2 * (of_start.second + s / 3 * of_start.third));
      m.omega = inverse_inertia_ * m.y;
    } else {
      start = m = exact(t + phase);
      start_phase = phase;
    }
  }
  return best;
}

/// Phase of the nearest point of the ring, within half a period of the expected phase.
double PolhodeError::nearest_of_ring(double t, const Vector3<double>& y, double expected) {
  for (std::size_t i = ring_.size(); i < points_; ++i) {
    ring_.push_back(exact(static_cast<double>(i) * search_step_).y);
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

PolhodeError::At PolhodeError::at(double t, const BodySnapshot<double>& body,
                                  const std::optional<Vector3<double>>& exact_omega) {
  const Vector3<double> y = inertia_ * (body.rotation.transpose() * body.angular_velocity);
  if (!y.allFinite()) return {t, t, std::numeric_limits<double>::infinity()};
  const double expected = phase_ + phase_rate_ * (t - t_);
  const bool near = std::abs(expected) <= reach_;
  const double from = near ? 0 : expected;
  const Momentum start = near && exact_omega ? Momentum{inertia_ * *exact_omega, *exact_omega} : exact(t + from);
  Nearest found = refined(t, y, from, start);
  // If y is close to the curve, the minimum next to the expected phase is the global one.
  constexpr double close = 0.02;
  if (!(found.distance <= close * size_)) {
    const double other = nearest_of_ring(t, y, expected);
    const Momentum there = exact(t + other);
    if ((y - there.y).norm() < found.distance) found = refined(t, y, other, there);
  }
  if (t > t_) phase_rate_ = (found.phase - phase_) / (t - t_);
  t_ = t;
  phase_ = found.phase;
  return {phase_, speed_ * phase_, found.distance / size_};
}

}  // namespace polhode::study::metrics
