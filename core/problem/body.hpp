// SPDX-License-Identifier: BSD-3-Clause
// A rigid body apart from its motion: mass, inertia, and whether it is free, pinned or static.
#pragma once

#include <string>

#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode {

/// The reference point of a body is its mass centre, or its pivot when it is pinned: positions, torques and inertia
/// are about that point.
struct Body {
  std::string name;
  double mass = 1;                                           ///< kg, positive
  Matrix3<double> inertia = Matrix3<double>::Identity();     ///< kg m², body axes, about the reference point
  bool pinned = false;                                       ///< turns about a point fixed in the world
  bool fixed = false;                                        ///< static: never moves, has no state
  Vector3<double> center_of_mass = Vector3<double>::Zero();  ///< m, body axes, from the pivot; pinned only
};

/// The start of a body as a scenario states it: of the reference point, with ω in the axes in which it was given.
struct BodyStart {
  Vector3<double> position = Vector3<double>::Zero();              ///< m, world, of the reference point
  Quaternion<double> orientation = identity_quaternion<double>();  ///< body to world
  Vector3<double> velocity = Vector3<double>::Zero();              ///< m/s, world, of the reference point
  Vector3<double> angular_velocity = Vector3<double>::Zero();  ///< rad/s, in world axes unless the next line says body
  bool angular_velocity_in_body = false;
};

}  // namespace polhode
