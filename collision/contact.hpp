// SPDX-License-Identifier: BSD-3-Clause
// Where and how two bodies touch, as the slides define it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision {

/// Which parts of two shapes touch. The numbers are those of the shapes' own faces, edges and vertices, and stay the
/// same while the contact does: warm starting knows a contact by them.
struct Feature {
  /// A vertex of A and a face of B, a face of A and a vertex of B, an edge of each, anything else.
  enum class Kind : std::uint8_t { vertex_face, face_vertex, edge_edge, other };
  Kind kind;
  std::uint32_t of_a, of_b;
  bool operator==(const Feature&) const = default;
};

/// One point of a contact patch. Without values of its own, so that a manifold without contact costs next to nothing.
struct ContactPoint {
  Vector3<double> point;  ///< m, world, half way between the two surfaces
  double depth;           ///< m along the normal, positive when overlapping
  Feature feature;
};

/// The contact patch of two convex shapes: one normal, and the points that matter.
struct Manifold {
  static constexpr std::size_t capacity = 8;
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit, world, from B to A: the impulse on A is +j n
  std::array<ContactPoint, capacity> points{};
  std::size_t count = 0;  ///< 0: no contact
};

/// Signed distance of two shapes: positive apart, negative the depth of overlap, the smallest translation that
/// separates.
struct Distance {
  double distance = 0;                               ///< m
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit, world, from B to A
  Vector3<double> on_a = Vector3<double>::Zero();    ///< m, world: the witness points
  Vector3<double> on_b = Vector3<double>::Zero();
};

}  // namespace polhode
