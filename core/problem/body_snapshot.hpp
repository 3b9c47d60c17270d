// SPDX-License-Identifier: BSD-3-Clause
// The place and the motion of a body at one instant, as trajectories, the window and measurements read it. A BodyMotion
// (core/problem/force.hpp) is about the reference point instead of the mass centre and has what forces read alone; a
// BodyStart (core/problem/body.hpp) is what a scenario states.
#pragma once

#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline problem {

/// World axes, SI units. R may have left its manifold where the matrix is stored; the quaternion is then near it.
template <class S>
struct BodySnapshot {
  Vector3<S> position = Vector3<S>::Zero();              ///< position of the mass centre, m
  Quaternion<S> orientation = identity_quaternion<S>();  ///< quaternion, stored or by Shepperd's method from R
  Matrix3<S> rotation = Matrix3<S>::Identity();          ///< rotation matrix R, body to world
  Vector3<S> velocity = Vector3<S>::Zero();              ///< velocity of the mass centre, m/s
  Vector3<S> angular_velocity = Vector3<S>::Zero();      ///< angular velocity ω, rad/s
  Vector3<S> angular_momentum = Vector3<S>::Zero();      ///< angular momentum about the reference point, kg m²/s
};

}  // namespace polhode::core::problem
