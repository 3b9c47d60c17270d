// SPDX-License-Identifier: BSD-3-Clause
// The error of a free body's angular momentum in the body, y = IΩ, taken apart along the polhode and off it.
//
// The exact y runs round its polhode, the curve on which the energy ellipsoid meets the sphere |y| = const. With the
// point of it that is nearest to a computed y at t,
//   phase τ: min over τ of |y − y_exact(t + τ)|, in s; positive: the computed motion is ahead;
//   off: that distance over |y(0)|: what changed energy and |y|, and so the polhode itself.
// At the nearest point the two are at right angles: |y − y_exact(t)|² ≈ (|ẏ| τ)² + off².
#pragma once

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
    double off = 0;        ///< relative
  };

  /// Absent unless one body moves, without torque, and its ω changes in the body: else its polhode is no curve.
  static std::optional<PolhodeError> of(const System<double>& system);

  /// Follows the motion forwards in time: the phase goes on from that of the last call, beyond whole turns. It needs
  /// some calls in each turn of phase that is lost.
  At at(double t, const BodySnapshot<double>& body);

 private:
  PolhodeError(const Matrix3<double>& inertia, const Vector3<double>& omega_body);
  struct Momentum {
    Vector3<double> value, rate, second;  ///< kg m²/s and its time derivatives in the body
  };
  Momentum exact(double t) const;
  double refined(double t, const Vector3<double>& y, double phase) const;
  double nearest_of_ring(double t, const Vector3<double>& y, double expected) const;

  Matrix3<double> inertia_, inverse_inertia_;
  FreeTop top_;
  double speed_, size_;                ///< |ω(0)|, |y(0)|
  double search_step_;                 ///< s, between the points of the ring
  std::vector<Vector3<double>> ring_;  ///< exact y over a period, for the search of the nearest point
  double t_ = 0, phase_ = 0, phase_rate_ = 0;
};

}  // namespace polhode::study
