// SPDX-License-Identifier: BSD-3-Clause
// Error of a free body's angular momentum in the body frame, y = IΩ, split into a part along the polhode and a part off
// it.
//
// The exact y moves along its polhode, the intersection of the energy ellipsoid and the sphere |y| = const. For a
// computed y at time t:
//   phase τ: the τ that minimises |y − y_exact(t + τ)|, in s; positive if the computed motion is ahead;
//   off: the minimum over |y(0)|, due to errors of the energy and of |y|, which change the polhode itself.
// At the nearest point the two parts are at right angles: |y − y_exact(t)|² ≈ (|ẏ| τ)² + (off |y(0)|)².
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/exact/free_top.hpp"
#include "core/system/system.hpp"

namespace polhode::study::inline metrics {

class PolhodeError {
 public:
  struct At {
    double phase = 0;      ///< s
    double phase_rad = 0;  ///< |ω(0)| τ
    double off = 0;        ///< relative error off the polhode
  };

  /// Absent unless one body moves, no joint and no torque acts on it, and its body-frame ω varies; otherwise its
  /// polhode is a point.
  static std::optional<PolhodeError> of(const System<double>& system);

  /// The error of the body at time t, s. Calls must go forwards in time: the phase continues from that of the last
  /// call, beyond whole periods. Several calls are required for each period by which the phase changes.
  /// exact_omega: exact angular velocity at t, body axes, rad/s, if it is known already; saves its computation.
  At at(double t, const BodySnapshot<double>& body, const std::optional<Vector3<double>>& exact_omega = {});

 private:
  PolhodeError(const Matrix3<double>& inertia, const Vector3<double>& omega_body);
  struct Momentum {
    Vector3<double> y, omega;                                ///< kg m²/s and rad/s, body frame
    Vector3<double> rate() const { return y.cross(omega); }  ///< ẏ, Euler's equations
  };
  struct Derivatives {
    Vector3<double> rate = Vector3<double>::Zero(), second = rate, third = rate;  ///< of y in time, body frame
  };
  struct Nearest {
    double phase = 0;     ///< s
    double distance = 0;  ///< of y from the exact one at that phase, kg m²/s
  };
  Momentum exact(double t) const;
  Derivatives derivatives(const Momentum& m) const;
  Nearest refined(double t, const Vector3<double>& y, double phase, Momentum start) const;
  double nearest_of_ring(double t, const Vector3<double>& y, double expected);

  Matrix3<double> inertia_, inverse_inertia_;
  FreeTop top_;
  double speed_, size_;  ///< |ω(0)|, |y(0)|
  double reach_;         ///< time within which the cubic Taylor polynomial of y is exact to round-off, s
  double search_step_;   ///< time between the points of the ring, s
  std::size_t points_;   ///< number of the points of the ring
  /// Exact y at equal steps over a period, for the search of the nearest point; made when it is first needed.
  std::vector<Vector3<double>> ring_;
  double t_ = 0, phase_ = 0, phase_rate_ = 0;
};

}  // namespace polhode::study::metrics
