// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of a face of a box and the opposite face of another box: a parallelogram clipped by a rectangle.
// Sutherland & Hodgman (Reentrant polygon clipping, 1974) clip by one side after the other. Here all candidates are
// computed at once, four numbers in a register: the corners of each polygon that lie within the other, and the
// crossings of their sides.
#pragma once

#include <array>
#include <cstdint>

#include "collision/contact.hpp"
#include "collision/pose.hpp"

namespace polhode::inline collision::inline narrow {

/// Number of the edge of a box that starts at a vertex and runs along +axis; edges are sorted by their two vertices.
inline constexpr std::uint32_t edge_from[8][3] = {{0, 1, 2}, {0, 3, 4},  {5, 1, 6},  {5, 3, 7},
                                                  {8, 9, 2}, {8, 10, 4}, {11, 9, 6}, {11, 10, 7}};

/// The axis of the largest component in magnitude.
inline int largest_component(const Vector3<double>& n) {
  const Vector3<double> m = n.cwiseAbs();
  return m[0] >= m[1] && m[0] >= m[2] ? 0 : m[1] >= m[2] ? 1 : 2;
}

/// Number of the face of a box whose normal is ± an axis, with the sign of n along it.
inline std::uint32_t face_along(const Vector3<double>& n, int axis) {
  return std::uint32_t(2 * axis) + (n[axis] > 0 ? 1 : 0);
}

/// The box that has the reference face.
struct ReferenceFace {
  const Vector3<double>& half;  ///< m
  const Pose& pose;
  std::uint32_t face;
  bool of_b;  ///< true: the box is B of the manifold
};

/// The other box, in the axes of the reference box.
struct IncidentBox {
  const Vector3<double>& half;    ///< m
  const Matrix3<double>& turn;    ///< column j is its axis j
  const Vector3<double>& offset;  ///< its centre, m
};

/// Sets the patch in the manifold; returns false if no part of it is within `margin` (m) of the face.
bool faces_patch(const ReferenceFace& reference, const IncidentBox& incident, double margin, Manifold& manifold);

}  // namespace polhode::collision::narrow
