// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of a face of a box and the face of another box that looks at it: a parallelogram clipped by a
// rectangle. What Sutherland & Hodgman (Reentrant polygon clipping, 1974) find side by side is here looked for all at
// once, four numbers in a register: the corners of the one that lie within the other, and where their sides cross.
#pragma once

#include <array>
#include <cstdint>

#include "collision/contact.hpp"
#include "collision/pose.hpp"

namespace polhode::inline collision {

/// Number of a box's edge that starts at a vertex along an axis upwards: edges are sorted by their two vertices.
inline constexpr std::uint32_t edge_from[8][3] = {{0, 1, 2}, {0, 3, 4},  {5, 1, 6},  {5, 3, 7},
                                                  {8, 9, 2}, {8, 10, 4}, {11, 9, 6}, {11, 10, 7}};

/// The axis of the largest component.
inline int largest_component(const Vector3<double>& n) {
  const Vector3<double> m = n.cwiseAbs();
  return m[0] >= m[1] && m[0] >= m[2] ? 0 : m[1] >= m[2] ? 1 : 2;
}

/// Number of the face that looks along an axis, as n does.
inline std::uint32_t face_along(const Vector3<double>& n, int axis) {
  return std::uint32_t(2 * axis) + (n[axis] > 0 ? 1 : 0);
}

/// A box that shows a face to another one.
struct ReferenceFace {
  const Vector3<double>& half;  ///< m
  const Pose& pose;
  std::uint32_t face;
  bool of_b;  ///< the box is the manifold's B
};

/// The other box, in the axes of the reference box.
struct IncidentBox {
  const Vector3<double>& half;    ///< m
  const Matrix3<double>& turn;    ///< column j is its axis j
  const Vector3<double>& offset;  ///< its centre, m
};

/// The patch in the manifold; false where no part of it is within `margin` (m) of the face.
bool faces_patch(const ReferenceFace& reference, const IncidentBox& incident, double margin, Manifold& manifold);

}  // namespace polhode
