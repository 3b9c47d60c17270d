// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of two faces: the incident face is clipped by the sides of the reference face (Sutherland &
// Hodgman, Reentrant polygon clipping, 1974), in the plane of the reference face. What each corner of the patch is made
// of is kept: a vertex of the one over the face of the other, or two edges that cross. That does not depend on which
// face is the reference, so a contact keeps its name when they change places.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "collision/contact.hpp"

namespace polhode::inline collision {

/// Faces at most this far from parallel meet as faces: 0.1 rad. Then the whole patch counts, also where it is apart, so
/// that a body that rocks keeps its points.
inline constexpr double cosine_of_rocking = 0.995;

/// A side of the reference face, whose inside is x nx + y ny <= offset; one after the other, counter-clockwise.
struct PatchSide {
  double nx = 0, ny = 0, offset = 0;
  std::uint32_t edge = 0, start = 0;  ///< of the reference shape: the edge, and the vertex where it starts
};

/// A corner of the incident face, or of what is left of it, and the edge that leaves it.
struct PatchCorner {
  double x = 0, y = 0, height = 0;  ///< m, above the plane of the reference face
  Feature feature{};                ///< of_a: the reference shape's part, of_b: the incident shape's
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

/// Clips `corners`, of which there are `count`, in place; both buffers have room for as many as `count` and the sides
/// together. Returns where the result stands. `incident_face` is its number, `tolerance` (m) how far a vertex may be
/// outside.
std::span<PatchCorner> clip_patch(std::span<const PatchSide> sides, std::uint32_t incident_face, double tolerance,
                                  std::span<PatchCorner> corners, std::size_t count, std::span<PatchCorner> buffer);

/// Corners side by side, as SIMD takes them, sorted by their features. There is room for three more of each number.
struct CornersInLanes {
  double *x, *y, *height;  ///< m
  double* scratch;
  std::size_t count;
};

/// Of more than four corners the numbers of those that matter, as below; returns how many they are.
std::size_t choose_corners(const CornersInLanes& corners, std::array<std::uint32_t, Manifold::capacity>& chosen);

/// Up to four corners all of them; of more the deepest, the one furthest from it and the two that span the largest area
/// with them; and up to the capacity of a manifold others that add to it by more than 1/32. Moves them to the front,
/// over the others.
std::span<PatchCorner> those_that_matter(std::span<PatchCorner> corners);

/// The points of the patch that matter. Features are of the reference shape first.
void take_patch(const PatchFrame& frame, std::span<PatchCorner> corners, Manifold& manifold);

/// The manifold with A and B exchanged.
void mirror(Manifold& manifold);

}  // namespace polhode
