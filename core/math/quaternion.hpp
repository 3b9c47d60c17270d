// SPDX-License-Identifier: BSD-3-Clause
// Quaternion algebra: Hamilton, scalar first (w, x, y, z), body to world.
// Source: the engine slides ("Quaternion operations"); Kuipers, Quaternions and Rotation Sequences, 1999.
#pragma once

#include <cmath>

#include "core/math/lanes.hpp"
#include "core/math/linear_algebra.hpp"

namespace polhode::inline core::inline math {

/// (w, x, y, z). A plain 4-vector, so that it can also hold a quaternion whose length is not 1.
template <class S>
using Quaternion = Eigen::Matrix<S, 4, 1>;

template <class S>
Quaternion<S> identity_quaternion() {
  return Quaternion<S>(S(1), S(0), S(0), S(0));
}

/// Hamilton product a b: rotates by b first, then by a.
template <class S>
Quaternion<S> product(const Quaternion<S>& a, const Quaternion<S>& b) {
  return Quaternion<S>(
      a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
      a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]);
}

template <class S>
Quaternion<S> conjugate(const Quaternion<S>& q) {
  return Quaternion<S>(q[0], -q[1], -q[2], -q[3]);
}

/// The vector v as the pure quaternion 0 + v.
template <class S>
Quaternion<S> pure(const Vector3<S>& v) {
  return Quaternion<S>(S(0), v[0], v[1], v[2]);
}

/// Body to world, by the formula R = 1 − 2(y² + z²) … with q as stored: orthonormal only if |q| = 1.
template <class S>
Matrix3<S> rotation_matrix_stored(const Quaternion<S>& q) {
  const S w = q[0], x = q[1], y = q[2], z = q[3];
  const S x2 = x + x, y2 = y + y, z2 = z + z;
  Matrix3<S> r;
  r << S(1) - (y * y2 + z * z2), x * y2 - w * z2, x * z2 + w * y2,  //
      x * y2 + w * z2, S(1) - (x * x2 + z * z2), y * z2 - w * x2,   //
      x * z2 - w * y2, y * z2 + w * x2, S(1) - (x * x2 + y * y2);
  return r;
}

/// The rotation of q/|q|, body to world: the homogeneous form (w² + x² − y² − z²) … over |q|². The division runs beside
/// the products, which shortens the longest chain of operations in a right-hand side.
template <class S>
Matrix3<S> rotation_matrix(const Quaternion<S>& q) {
  const S w = q[0], x = q[1], y = q[2], z = q[3];
  const S ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const S s = S(1) / ((ww + xx) + (yy + zz));
  const S s2 = s + s;
  Matrix3<S> r;
  r << ((ww + xx) - (yy + zz)) * s, (x * y - w * z) * s2, (x * z + w * y) * s2,  //
      (x * y + w * z) * s2, ((ww + yy) - (xx + zz)) * s, (y * z - w * x) * s2,   //
      (x * z - w * y) * s2, (y * z + w * x) * s2, ((ww + zz) - (xx + yy)) * s;
  return r;
}

/// exp of half the rotation vector φ (rad): the unit quaternion of a turn by |φ| about φ/|φ|.
template <class S>
Quaternion<S> quaternion_from_rotation_vector(const Vector3<S>& phi) {
  using std::cos, std::sin, std::sqrt;
  const S angle = sqrt(phi.squaredNorm());
  const S half = angle / S(2);
  // sin(x)/x by its series below the square root of the rounding unit, where it is exact to round-off.
  const S scale = select(half * half < rounding_unit<S>, S(S(0.5) - half * half / S(12)), S(sin(half) / angle));
  return Quaternion<S>(cos(half), scale * phi[0], scale * phi[1], scale * phi[2]);
}

/// The rotation vector (rad, length at most π) of the rotation of q/|q|; q and −q give the same vector.
template <class S>
Vector3<S> rotation_vector(const Quaternion<S>& q) {
  using std::atan2, std::sqrt;
  const Vector3<S> v = q.template tail<3>();
  const S n = sqrt(v.squaredNorm());
  const S w = q[0];
  if (n == S(0)) return Vector3<S>::Zero();
  const S angle = S(2) * (w < S(0) ? atan2(-n, -w) : atan2(n, w));
  return v * (angle / n);
}

/// Angular velocity given as axis and rate (slides, "Meaning of Angular Velocity"): ω = rate · axis/|axis|, rad/s.
template <class S>
Vector3<S> angular_velocity_from_axis_rate(const Vector3<S>& axis, S rate) {
  return axis * (rate / axis.norm());
}

/// The unit quaternion of a rotation matrix (Shepperd 1978: computed from the largest of the four components).
template <class S>
Quaternion<S> quaternion_from_rotation_matrix(const Matrix3<S>& r) {
  using std::sqrt;
  const S trace = r(0, 0) + r(1, 1) + r(2, 2);
  Quaternion<S> q;
  if (trace >= r(0, 0) && trace >= r(1, 1) && trace >= r(2, 2)) {
    q = {S(1) + trace, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  } else if (r(0, 0) >= r(1, 1) && r(0, 0) >= r(2, 2)) {
    q = {r(2, 1) - r(1, 2), S(1) + r(0, 0) - r(1, 1) - r(2, 2), r(0, 1) + r(1, 0), r(0, 2) + r(2, 0)};
  } else if (r(1, 1) >= r(2, 2)) {
    q = {r(0, 2) - r(2, 0), r(0, 1) + r(1, 0), S(1) + r(1, 1) - r(0, 0) - r(2, 2), r(1, 2) + r(2, 1)};
  } else {
    q = {r(1, 0) - r(0, 1), r(0, 2) + r(2, 0), r(1, 2) + r(2, 1), S(1) + r(2, 2) - r(0, 0) - r(1, 1)};
  }
  return q / sqrt(q.squaredNorm());
}

/// Lane-by-lane overload of the function above.
template <>
inline Quaternion<Lanes> quaternion_from_rotation_matrix(const Matrix3<Lanes>& r) {
  Quaternion<Lanes> q;
  for (int i = 0; i < lane_count; ++i) {
    const Matrix3<double> one = r.unaryExpr([i](const Lanes& x) { return x[i]; });
    const Quaternion<double> alone = quaternion_from_rotation_matrix<double>(one);
    for (int k = 0; k < 4; ++k) q[k].set(i, alone[k]);
  }
  return q;
}

/// Angle (rad, in [0, π]) of the rotation from the attitude of a to that of b; signs and lengths of a and b do not
/// matter.
template <class S>
S angle_between(const Quaternion<S>& a, const Quaternion<S>& b) {
  using std::abs, std::atan2, std::sqrt;
  const Quaternion<S> d = product(conjugate(a), b);
  return S(2) * atan2(sqrt(d.template tail<3>().squaredNorm()), abs(d[0]));
}

}  // namespace polhode::core::math
