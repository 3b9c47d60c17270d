// SPDX-License-Identifier: BSD-3-Clause
// The two representations of SO(3): storage of an orientation, its rotation matrix, and its rate under ω.
//   quaternion: q̇ = ½ ω q (world ω; engine slides, θ' = ½ω θ), q̇ = ½ q Ω (body Ω)
//   matrix:     Ṙ = ω* R (world ω; course report, 2.1),         Ṙ = R Ω*  (body Ω)
#pragma once

#include <cmath>

#include "core/math/lanes.hpp"
#include "core/math/quaternion.hpp"
#include "core/system/formulation.hpp"

namespace polhode::inline core::inline system {

/// Representation O of an orientation in the scalar S.
template <class S, Orientation O>
struct Chart;

template <class S>
struct Chart<S, Orientation::quaternion> {
  static constexpr int size = 4;
  using Value = Quaternion<S>;

  static Value load(const S* c) { return Eigen::Map<const Value>(c); }
  static void store(const Value& q, S* c) { Eigen::Map<Value>{c} = q; }

  static Matrix3<S> rotation(const Value& q, RotationFrom from) {
    return from == RotationFrom::normalized ? rotation_matrix<S>(q) : rotation_matrix_stored<S>(q);
  }

  static Value rate_world(const Value& q, const Vector3<S>& w) {
    const Vector3<S> a = S(0.5) * w;
    return Value(-a[0] * q[1] - a[1] * q[2] - a[2] * q[3],  //
                 a[0] * q[0] + a[1] * q[3] - a[2] * q[2],   //
                 a[1] * q[0] + a[2] * q[1] - a[0] * q[3],   //
                 a[2] * q[0] + a[0] * q[2] - a[1] * q[1]);
  }
  static Value rate_body(const Value& q, const Vector3<S>& w) {
    const Vector3<S> a = S(0.5) * w;
    return Value(-a[0] * q[1] - a[1] * q[2] - a[2] * q[3],  //
                 a[0] * q[0] + a[2] * q[2] - a[1] * q[3],   //
                 a[1] * q[0] + a[0] * q[3] - a[2] * q[1],   //
                 a[2] * q[0] + a[1] * q[1] - a[0] * q[2]);
  }

  /// Left and right multiplication by the unit quaternion d: d q for a rotation in world axes, q d in body axes.
  static Value turned_in_world(const Value& q, const Quaternion<S>& d) { return product<S>(d, q); }
  static Value turned_in_body(const Value& q, const Quaternion<S>& d) { return product<S>(q, d); }

  /// q d computed as q + q (d − 1) with 1 − d_w = |d_v|²/(1 + d_w). Over many small rotations |q| then does not
  /// accumulate the round-off of |d|.
  static Value carried_in_body(const Value& q, const Quaternion<S>& d) {
    if (!(d[0] > S(0))) return turned_in_body(q, d);
    const S versine = d.template tail<3>().squaredNorm() / (S(1) + d[0]);
    return q + product<S>(q, Quaternion<S>(-versine, d[1], d[2], d[3]));
  }

  static S defect(const Value& q) {
    using std::abs, std::sqrt;
    return abs(sqrt(q.squaredNorm()) - S(1));
  }
  static Value project(const Value& q) {
    using std::sqrt;
    return q * (S(1) / sqrt(q.squaredNorm()));
  }
  static Value from_quaternion(const Quaternion<S>& q) { return q; }
  static Quaternion<S> to_quaternion(const Value& q) { return q; }
};

template <class S>
struct Chart<S, Orientation::matrix> {
  static constexpr int size = 9;
  using Value = Matrix3<S>;

  static Value load(const S* c) { return Eigen::Map<const Value>(c); }
  static void store(const Value& r, S* c) { Eigen::Map<Value>{c} = r; }

  static Matrix3<S> rotation(const Value& r, RotationFrom) { return r; }

  static Value rate_world(const Value& r, const Vector3<S>& w) {
    Value d;
    for (int j = 0; j < 3; ++j) {
      d(0, j) = w[1] * r(2, j) - w[2] * r(1, j);
      d(1, j) = w[2] * r(0, j) - w[0] * r(2, j);
      d(2, j) = w[0] * r(1, j) - w[1] * r(0, j);
    }
    return d;
  }
  static Value rate_body(const Value& r, const Vector3<S>& w) {
    Value d;
    for (int i = 0; i < 3; ++i) {
      d(i, 0) = r(i, 1) * w[2] - r(i, 2) * w[1];
      d(i, 1) = r(i, 2) * w[0] - r(i, 0) * w[2];
      d(i, 2) = r(i, 0) * w[1] - r(i, 1) * w[0];
    }
    return d;
  }

  static Value turned_in_world(const Value& r, const Quaternion<S>& d) { return rotation_matrix<S>(d) * r; }
  static Value turned_in_body(const Value& r, const Quaternion<S>& d) { return r * rotation_matrix<S>(d); }

  /// R dR computed as R + R (dR − 1) with dR − 1 = 2 (w + v*) v*, d = (w, v). This reduces the round-off over many
  /// small rotations.
  static Value carried_in_body(const Value& r, const Quaternion<S>& d) {
    const Matrix3<S> v = skew<S>(d.template tail<3>());
    return r + r * (S(2) * (d[0] * v + v * v));
  }

  static S defect(const Value& r) {
    using std::sqrt;
    return sqrt((r.transpose() * r - Value::Identity()).squaredNorm());
  }

  /// Polar factor of R, the nearest rotation in the Frobenius norm, to round-off. Computed by Newton iteration
  /// R ← ½ (R + R⁻ᵀ) (Higham 1986). For a matrix far from every rotation the result is not a rotation in general.
  static Value project(const Value& start) {
    using std::sqrt;
    Value r = start;
    typename LaneType<S>::Mask going(true);
    for (int i = 0; i < 32; ++i) {
      Value cofactors;
      cofactors.col(0) = Vector3<S>(r.col(1).cross(r.col(2)));
      cofactors.col(1) = Vector3<S>(r.col(2).cross(r.col(0)));
      cofactors.col(2) = Vector3<S>(r.col(0).cross(r.col(1)));
      const S determinant = r.col(0).dot(cofactors.col(0));
      const Value next = S(0.5) * (r + cofactors / determinant);
      const S change = (next - r).squaredNorm();
      r = next.binaryExpr(r, [going](const S& now, const S& old) { return select(going, now, old); });
      // The error after an iteration is about half the square of the change. Stop once it is below round-off.
      going = going & (change > rounding_unit<S>);
      if (!any(going)) break;
    }
    return r;
  }
  static Value from_quaternion(const Quaternion<S>& q) { return rotation_matrix<S>(q); }
  static Quaternion<S> to_quaternion(const Value& r) { return quaternion_from_rotation_matrix<S>(r); }
};

}  // namespace polhode::core::system
