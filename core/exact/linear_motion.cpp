// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/linear_motion.hpp"

#include <cmath>

namespace polhode::inline core::inline exact {

LinearMotion::LinearMotion(double stiffness, double damping)
    : stiffness_(stiffness),
      half_damping_(damping / 2),
      gap_((std::sqrt(stiffness) - damping / 2) * (std::sqrt(stiffness) + damping / 2)) {}

LinearMotion::Response LinearMotion::at(double t) const {
  if (stiffness_ == 0 && half_damping_ == 0) return {t, t * t / 2, 1};
  const double speed = std::sqrt(std::abs(gap_)), angle = speed * t;
  if ((std::sqrt(stiffness_) + half_damping_) * std::abs(t) < 1) {
    // Power series of by_acceleration in t: (n + 1)(n + 2) c_(n+2) = −2γ (n + 1) c_(n+1) − ω² c_n.
    double before = 0, now = t * t / 2;  // terms n + 1 and n + 2
    Response r{t, now, 1};
    for (int n = 1; n < 30; ++n) {
      const double next = -(2 * half_damping_ * t * now * (n + 1) + stiffness_ * t * t * before) / ((n + 1) * (n + 2));
      r.by_acceleration += next;
      r.by_velocity += (n + 2) * next / t;
      r.rate_by_velocity += (n + 2) * (n + 1) * next / (t * t);
      before = now;
      now = next;
    }
    return t == 0 ? Response{0, 0, 1} : r;
  }
  if (gap_ < 0 && angle > 0.5) {
    // Overdamped: two decay rates. The slower one follows from the product of the roots, without cancellation.
    const double fast = half_damping_ + speed, slow = stiffness_ / fast, apart = 2 * speed;
    const auto part = [t](double rate) { return rate == 0 ? t : -std::expm1(-rate * t) / rate; };
    return {(std::exp(-slow * t) - std::exp(-fast * t)) / apart, (part(slow) - part(fast)) / apart,
            (fast * std::exp(-fast * t) - slow * std::exp(-slow * t)) / apart};
  }
  const double decay = std::exp(-half_damping_ * t);
  const double cosine = gap_ < 0 ? std::cosh(angle) : std::cos(angle);
  const double sine = angle == 0 ? t : (gap_ < 0 ? std::sinh(angle) : std::sin(angle)) / speed;  // divided by ν
  if (half_damping_ == 0) {
    const double half_sine = std::sin(angle / 2);
    return {sine, 2 * half_sine * half_sine / stiffness_, cosine};
  }
  return {decay * sine, (1 - decay * (cosine + half_damping_ * sine)) / stiffness_,
          decay * (cosine - half_damping_ * sine)};
}

}  // namespace polhode::core::exact
