// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of two faces: the incident face is clipped by the sides of the reference face (Sutherland &
// Hodgman, Reentrant polygon clipping, 1974), in the plane of the reference face. Each corner of the patch keeps its
// feature: a vertex of one face over the other, or two edges that cross. The feature does not depend on which face is
// the reference, so a contact keeps its identity when they change places.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "collision/contact.hpp"

namespace polhode::inline collision::inline narrow {

/// Faces at most this far from parallel (0.1 rad) meet as faces. The whole patch then counts, also where the faces are
/// apart, so that a rocking body keeps its contact points.
inline constexpr double cosine_of_rocking = 0.995;

/// A side of the reference face; the inside is x nx + y ny <= offset. Sides are in counter-clockwise order.
struct PatchSide {
  double nx = 0, ny = 0, offset = 0;
  std::uint32_t edge = 0, start = 0;  ///< edge of the reference shape, and the vertex where it starts
};

/// A corner of the incident face, or of its clipped rest, and the edge that leaves it.
struct PatchCorner {
  double x = 0, y = 0, height = 0;  ///< place in the plane of the reference face, and height above it, m
  Feature feature{};                ///< of_a: feature of the reference shape, of_b: of the incident shape
  bool along_side = false;          ///< the leaving edge lies on a side of the reference face
  std::uint32_t edge = 0;           ///< number of the incident shape's edge, or of the side
};

/// A plane in the world: x, y and height (m) along three axes.
struct PatchFrame {
  Vector3<double> origin, x, y, normal;  ///< the normal points out of the reference shape
  Vector3<double> to_world(double along_x, double along_y, double height) const {
    return origin + along_x * x + along_y * y + height * normal;
  }
};

/// Clips the first `count` of `corners` in place; both buffers have room for `count` corners plus one for each side.
/// Returns the part of a buffer that holds the result. `incident_face` is the number of that face; `tolerance` (m): a
/// vertex outside by less counts as inside.
std::span<PatchCorner> clip_patch(std::span<const PatchSide> sides, std::uint32_t incident_face, double tolerance,
                                  std::span<PatchCorner> corners, std::size_t count, std::span<PatchCorner> buffer);

/// Corners as separate arrays, for SIMD, sorted by feature. Each array has room for three more numbers.
struct CornersInLanes {
  double *x, *y, *height;  ///< m
  double* scratch;
  std::size_t count;
};

/// Chooses among more than four corners as those_that_matter() does; returns their number.
std::size_t choose_corners(const CornersInLanes& corners, std::array<std::uint32_t, Manifold::capacity>& chosen);

/// Reduces the corners to those that determine the contact. Up to four corners: all of them. More: the deepest, the one
/// furthest from it, the two that span the largest area with them, and, up to the capacity of a manifold, others that
/// add more than 1/32 to the area. Moves them to the front, overwriting the others.
std::span<PatchCorner> those_that_matter(std::span<PatchCorner> corners);

/// Sets the points of the manifold to the corners that determine the contact. Features list the reference shape first.
void take_patch(const PatchFrame& frame, std::span<PatchCorner> corners, Manifold& manifold);

/// The manifold with A and B exchanged.
void mirror(Manifold& manifold);

}  // namespace polhode::collision::narrow
