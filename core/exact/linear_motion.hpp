// SPDX-License-Identifier: BSD-3-Clause
// The exact solution of ẍ + 2γ ẋ + ω² x = a: springs without rest length, linear drag and constant forces on a mass
// centre, and a torque and angular drag about a fixed axis.
// Source: Landau & Lifshitz, Mechanics, 3rd ed., section 25; written so that no case is a limit of another.
#pragma once

namespace polhode::inline core::inline exact {

class LinearMotion {
 public:
  /// stiffness: ω² (1/s²); damping: 2γ (1/s); neither negative.
  LinearMotion(double stiffness, double damping);

  /// Response of x(t) and ẋ(t) to the initial velocity v = ẋ(0) and to the initial acceleration A = a − ω² x(0), for
  /// x(0) = 0:
  ///   x(t) = x(0) + v by_velocity + A by_acceleration,  ẋ(t) = v rate_by_velocity + A by_velocity.
  struct Response {
    double by_velocity;      ///< s
    double by_acceleration;  ///< s²
    double rate_by_velocity;
  };
  /// The response at t ≥ 0 (s), to a few units of round-off times 1 + (ω + γ) t.
  Response at(double t) const;

 private:
  double stiffness_, half_damping_;
  double gap_;  ///< ω² − γ²
};

}  // namespace polhode::core::exact
