// SPDX-License-Identifier: BSD-3-Clause
// The motion of a free top whose angular velocity varies, as a function of time. FreeTop (core/exact/free_top.hpp)
// makes its constants of the inertia and the start, and explains the formulas.
#pragma once

#include "core/exact/motion_at.hpp"
#include "core/math/elliptic.hpp"
#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline exact {

/// S: double, or Lanes with a top in each lane.
template <class S>
struct VaryingTop {
  Quaternion<S> left = identity_quaternion<S>(), body_to_frame = left;
  Matrix3<S> axes = Matrix3<S>::Identity();            ///< columns: the axes A, B, C in the body
  Vector3<S> momentum_amplitude = Vector3<S>::Zero();  ///< Y/G
  Vector3<S> rate_per_momentum = Vector3<S>::Zero();   ///< G/A, G/B, G/C, rad/s
  S phase{0.0}, phase_rate{0.0};                       ///< u0; λ, rad/s
  S precession_rate{0.0};                              ///< ℓ, rad/s
  JacobiEllipticOf<S> jacobi;
  ThetaDirectionOf<S> theta;

  TopAt<S> at(S t) const;
  Vector3<S> angular_velocity_body(S t) const;

  /// y/G in A, B, C.
  Vector3<S> momentum_direction(S u) const;
  /// Rot P.
  Quaternion<S> attitude_in_frame(S t, S u, const Vector3<S>& momentum_direction) const;
};

}  // namespace polhode::core::exact
