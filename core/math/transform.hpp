// SPDX-License-Identifier: BSD-3-Clause
// The 4×4 homogeneous transform of a pose, body to world: (x_world, 1) = M (x_body, 1), M = [R p; 0 1].
// Source: the engine slides, "Computing the Transform Matrix". The 3×3 block that they print (2xy + 2zw at row 1,
// column 2) is Rᵀ, the rotation from world to body, of the quaternion that their own θ' = ½ωθ moves: a matrix for row
// vectors, put before a column p. Here the block is R, so that one matrix takes points of the body to the world.
#pragma once

#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline math {

template <class S>
using Matrix4 = Eigen::Matrix<S, 4, 4>;

/// position: m, world, of the body's reference point; rotation: body to world, as stored.
template <class S>
Matrix4<S> body_to_world(const Vector3<S>& position, const Matrix3<S>& rotation) {
  Matrix4<S> m = Matrix4<S>::Identity();
  m.template topLeftCorner<3, 3>() = rotation;
  m.template topRightCorner<3, 1>() = position;
  return m;
}

/// The same transform with the rotation of q/|q|.
template <class S>
Matrix4<S> body_to_world(const Vector3<S>& position, const Quaternion<S>& orientation) {
  return body_to_world<S>(position, rotation_matrix<S>(orientation));
}

/// A point (m) from body axes to the world.
template <class S>
Vector3<S> transform_point(const Matrix4<S>& body_to_world, const Vector3<S>& point) {
  return body_to_world.template topLeftCorner<3, 3>() * point + body_to_world.template topRightCorner<3, 1>();
}

}  // namespace polhode::core::math
