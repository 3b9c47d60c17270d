// SPDX-License-Identifier: BSD-3-Clause
// The exact solution of ẍ + 2γ ẋ + ω² x = a: springs without rest length, linear drag and constant forces on a mass
// centre, and a torque and angular drag about a fixed axis.
// Source: Landau & Lifshitz, Mechanics, 3rd ed., section 25; written so that no case is a limit of another.
#pragma once

namespace polhode {

class LinearMotion {
 public:
  /// ω² in 1/s², 2γ in 1/s, neither negative.
  LinearMotion(double stiffness, double damping);

  /// What of x(t) and ẋ(t) is due to x(0) = 0, ẋ(0) = v and to the acceleration A = a − ω² x(0) at the start:
  ///   x(t) = x(0) + v by_velocity + A by_acceleration,  ẋ(t) = v rate_by_velocity + A by_velocity.
  struct Response {
    double by_velocity;      ///< s
    double by_acceleration;  ///< s²
    double rate_by_velocity;
  };
  /// To a few units of round-off times 1 + (ω + γ) t, for t ≥ 0.
  Response at(double t) const;

 private:
  double stiffness_, half_damping_;
  double gap_;  ///< ω² − γ²
};

}  // namespace polhode
