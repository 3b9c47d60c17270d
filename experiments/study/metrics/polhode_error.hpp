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
#include "experiments/study/metrics/polhode_curve.hpp"

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
  /// top: the exact rotation of the body, if it is known already; saves its computation.
  static std::optional<PolhodeError> of(const System<double>& system, const FreeTop* top = nullptr);

  /// The error of the body at time t, s. Calls must go forwards in time: the phase continues from that of the last
  /// call, beyond whole periods. Several calls are required for each period by which the phase changes.
  /// exact_omega: exact angular velocity at t, body axes, rad/s, if it is known already; saves its computation.
  At at(double t, const BodySnapshot<double>& body, const std::optional<Vector3<double>>& exact_omega = {});

 private:
  friend class PolhodeErrors;  // continues errors in lanes
  using Curve = PolhodeCurve<double>;

  PolhodeError(const Matrix3<double>& inertia, const Vector3<double>& omega_body, const FreeTop& top);
  Curve::Momentum exact(double t) const { return curve_.momentum(top_.angular_velocity_body(t)); }
  Curve::Nearest refined(double t, const Vector3<double>& y, double phase, const Curve::Momentum& start) const;
  Curve::Nearest searched(double t, const Vector3<double>& y, double expected, const Curve::Nearest& found);
  double nearest_of_ring(double t, const Vector3<double>& y, double expected);

  Curve curve_;  ///< its search_step is the time between the points of the ring
  FreeTop top_;
  std::size_t points_;  ///< number of the points of the ring
  /// Exact y at equal steps over a period, for the search of the nearest point; made when it is first needed.
  std::vector<Vector3<double>> ring_;
  double t_ = 0, phase_ = 0, phase_rate_ = 0;
};

}  // namespace polhode::study::metrics
