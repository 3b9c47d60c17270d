// SPDX-License-Identifier: BSD-3-Clause
// Contact points, contact normal and signed distance of two bodies, as the slides define them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision {

/// The parts of two shapes that touch. The numbers are those of the shapes' own faces, edges and vertices. They stay
/// the same as long as the contact lasts, so that warm starting identifies a contact by them.
struct Feature {
  /// A vertex of A and a face of B; a face of A and a vertex of B; an edge of each; anything else.
  enum class Kind : std::uint8_t { vertex_face, face_vertex, edge_edge, other };
  Kind kind;
  std::uint32_t of_a, of_b;
  bool operator==(const Feature&) const = default;
};

/// One point of a contact patch. It has no default values, so that a manifold without contact costs next to nothing.
struct ContactPoint {
  Vector3<double> point;  ///< point midway between the two surfaces, world axes, m
  double depth;           ///< depth along the normal, positive if the shapes overlap, m
  Feature feature;
};

/// The contact patch of two convex shapes: one normal, and the points that determine the contact.
struct Manifold {
  static constexpr std::size_t capacity = 8;
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit normal from B to A, world axes; the impulse on A is +j n
  std::array<ContactPoint, capacity> points{};
  std::size_t count = 0;  ///< 0: no contact
};

/// Signed distance of two shapes: positive if they are apart; if they overlap, minus the length of the smallest
/// translation that separates them.
struct Distance {
  double distance = 0;                               ///< m
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit normal from B to A, world axes
  Vector3<double> on_a = Vector3<double>::Zero();    ///< witness point on A, world axes, m
  Vector3<double> on_b = Vector3<double>::Zero();
};

/// The same with A and B exchanged.
inline Distance mirrored(Distance d) {
  for (int i = 0; i < 3; ++i) {
    d.normal[i] = -d.normal[i];
    std::swap(d.on_a[i], d.on_b[i]);
  }
  return d;
}

}  // namespace polhode::collision
