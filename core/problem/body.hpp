// SPDX-License-Identifier: BSD-3-Clause
// A rigid body apart from its motion: mass, inertia, and whether it is free, pinned or static.
#pragma once

#include <string>

#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline problem {

/// The reference point of a body is its mass centre, or its pivot when it is pinned: positions, torques and inertia
/// are about that point.
struct Body {
  std::string name;
  double mass = 1;                                           ///< mass, positive, kg
  Matrix3<double> inertia = Matrix3<double>::Identity();     ///< inertia about the reference point, body axes, kg m²
  bool pinned = false;                                       ///< turns about a point fixed in the world
  bool fixed = false;                                        ///< static: never moves, has no state
  Vector3<double> center_of_mass = Vector3<double>::Zero();  ///< mass centre from a pinned body's pivot, body axes, m
};

/// The start of a body as a scenario states it: of the reference point, with ω in the axes in which it was given.
struct BodyStart {
  Vector3<double> position = Vector3<double>::Zero();              ///< position of the reference point, world axes, m
  Quaternion<double> orientation = identity_quaternion<double>();  ///< body to world
  Vector3<double> velocity = Vector3<double>::Zero();              ///< velocity of the reference point, world axes, m/s
  Vector3<double> angular_velocity = Vector3<double>::Zero();  ///< angular velocity, axes as the next line says, rad/s
  bool angular_velocity_in_body = false;
};

}  // namespace polhode::core::problem
