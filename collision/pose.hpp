// SPDX-License-Identifier: BSD-3-Clause
// Position and rotation of a shape in the world.
#pragma once

#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode::inline collision {

/// x in the world = position + rotation · x in the shape's axes.
struct Pose {
  Vector3<double> position = Vector3<double>::Zero();      ///< m
  Matrix3<double> rotation = Matrix3<double>::Identity();  ///< body to world

  Vector3<double> to_world(const Vector3<double>& x) const { return position + rotation * x; }
  Vector3<double> to_body(const Vector3<double>& x) const { return rotation.transpose() * (x - position); }
};

}  // namespace polhode::collision
