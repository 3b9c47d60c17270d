// SPDX-License-Identifier: BSD-3-Clause
// The Minkowski difference A ⊖ B = {a − b} of two convex shapes, by its support function, in the axes of A with the
// origin at A. A ball is the point at its centre with a radius around it, a capsule its segment: what is left, the core,
// has corners only, and its distance is exact.
#pragma once

#include <cmath>

#include "collision/shapes/convex_hull.hpp"
#include "collision/shape.hpp"

namespace polhode {

struct ConvexCore {
  enum class Kind : std::uint8_t { point, segment, box, hull, smooth };
  Kind kind = Kind::point;
  double radius = 0;                                ///< m, around the core
  Vector3<double> half = Vector3<double>::Zero();   ///< m: of the box; of the segment the last counts
  const Shape* shape = nullptr;

  explicit ConvexCore(const Shape& s);  ///< of a convex, finite shape

  bool has_faces() const { return kind == Kind::box || kind == Kind::hull; }
  const ConvexHull& hull() const { return static_cast<const ConvexHull&>(*shape); }

  Vector3<double> support(const Vector3<double>& d) const {
    switch (kind) {
      case Kind::point: return Vector3<double>::Zero();
      case Kind::segment: return {0, 0, std::copysign(half[2], d[2])};
      case Kind::box: return {std::copysign(half[0], d[0]), std::copysign(half[1], d[1]), std::copysign(half[2], d[2])};
      case Kind::hull: return hull().support(d);
      case Kind::smooth: break;
    }
    return shape->support(d);
  }
};

/// A corner w = a − (R b + p) of the difference. The edges between corners are differences of a and of b, each in its
/// own axes, which keeps them exact beside a far larger partner.
struct MinkowskiCorner {
  Vector3<double> w, a, b;  ///< a in A's axes, b in B's
};

struct MinkowskiPair {
  ConvexCore a, b;
  Matrix3<double> rotation;  ///< from B's axes to A's
  Vector3<double> offset;    ///< of B's origin, in A's axes

  MinkowskiPair(const Shape& shape_a, const Pose& at_a, const Shape& shape_b, const Pose& at_b)
      : a(shape_a),
        b(shape_b),
        rotation(at_a.rotation.transpose() * at_b.rotation),
        offset(at_a.rotation.transpose() * (at_b.position - at_a.position)) {}

  MinkowskiCorner corner(const Vector3<double>& of_a, const Vector3<double>& of_b) const {
    return {of_a - (rotation * of_b + offset), of_a, of_b};
  }
  /// The corner furthest along d.
  MinkowskiCorner support(const Vector3<double>& d) const {
    return corner(a.support(d), b.support(-(rotation.transpose() * d)));
  }
  /// From corner i to corner j.
  Vector3<double> edge(const MinkowskiCorner& i, const MinkowskiCorner& j) const {
    return (j.a - i.a) - rotation * (j.b - i.b);
  }
};

}  // namespace polhode
