// SPDX-License-Identifier: BSD-3-Clause
// The Minkowski difference A ⊖ B = {a − b} of two convex shapes, by its support function, in the axes of A with the
// origin at A. The core of a ball is its centre, that of a capsule its segment, both with a radius around them. Cores
// have corners only, so the distance of two cores is exact.
#pragma once

#include <cmath>

#include "collision/shape.hpp"
#include "collision/shapes/convex_hull.hpp"

namespace polhode::inline collision::inline narrow {

struct ConvexCore {
  enum class Kind : std::uint8_t { point, segment, box, hull, smooth };
  static constexpr std::uint32_t no_vertex =
      0xffffffff;  ///< vertex number of a point that is no vertex, on a smooth core

  Kind kind = Kind::point;
  double radius = 0;                               ///< radius of the shape around the core, m
  Vector3<double> half = Vector3<double>::Zero();  ///< half extents of a box, m; a segment uses the last one only
  const Shape* shape = nullptr;

  explicit ConvexCore(const Shape& s);  ///< s must be convex and finite

  bool smooth() const { return kind == Kind::smooth; }
  bool has_faces() const { return kind == Kind::box || kind == Kind::hull; }
  const ConvexHull& hull() const { return static_cast<const ConvexHull&>(*shape); }

  /// Sets x to the point furthest along d; returns its vertex number. The components are written one by one: a copy of
  /// all three at once would have to wait for them.
  std::uint32_t support(const Vector3<double>& d, Vector3<double>& x) const {
    if (kind != Kind::box) return support_of_others(d, x);
    for (int i = 0; i < 3; ++i) x[i] = std::copysign(half[i], d[i]);
    return unsigned(!std::signbit(d[0])) | unsigned(!std::signbit(d[1])) << 1 | unsigned(!std::signbit(d[2])) << 2;
  }

  std::uint32_t vertex_count() const { return kind == Kind::box ? 8 : vertex_count_of_others(); }
  /// Sets x to vertex i, in the order of `Box` and `ConvexHull`.
  void vertex(std::uint32_t i, Vector3<double>& x) const {
    if (kind != Kind::box) return vertex_of_others(i, x);
    constexpr double sign[2] = {-1, 1};
    for (unsigned k = 0; k < 3; ++k) x[k] = sign[i >> k & 1] * half[k];
  }

 private:
  std::uint32_t support_of_others(const Vector3<double>& d, Vector3<double>& x) const;
  std::uint32_t vertex_count_of_others() const;
  void vertex_of_others(std::uint32_t i, Vector3<double>& x) const;
};

/// A corner w = a − (R b + p) of the difference. Edges between corners are differences of a and of R b, which keeps
/// them exact if the other shape is much larger.
struct MinkowskiCorner {
  Vector3<double> w;
  Vector3<double> a, turned_b;  ///< parts a and R b in A's axes, each from the origin of its own shape, m
  std::uint32_t vertex_a, vertex_b;

  bool operator==(const MinkowskiCorner& o) const {
    return vertex_a == o.vertex_a && vertex_b == o.vertex_b && w == o.w;
  }
};

/// The edge from corner i to corner j.
inline Vector3<double> edge(const MinkowskiCorner& i, const MinkowskiCorner& j) {
  return (j.a - i.a) - (j.turned_b - i.turned_b);
}

struct MinkowskiPair {
  ConvexCore a, b;
  Matrix3<double> rotation;  ///< rotation from B's axes to A's
  Vector3<double> offset;    ///< position of B's origin in A's axes, m

  MinkowskiPair(const Shape& shape_a, const Pose& at_a, const Shape& shape_b, const Pose& at_b)
      : a(shape_a),
        b(shape_b),
        rotation(at_a.rotation.transpose() * at_b.rotation),
        offset(at_a.rotation.transpose() * (at_b.position - at_a.position)) {}

  bool smooth() const { return a.smooth() || b.smooth(); }
  double radius() const { return a.radius + b.radius; }

  /// Completes a corner whose c.a is given by a point of B.
  void complete(MinkowskiCorner& c, const Vector3<double>& of_b) const {
    for (int i = 0; i < 3; ++i) {
      const double turned = rotation(i, 0) * of_b[0] + rotation(i, 1) * of_b[1] + rotation(i, 2) * of_b[2];
      c.turned_b[i] = turned;
      c.w[i] = c.a[i] - (turned + offset[i]);
    }
  }
  /// Sets c to the corner of a vertex of A and a vertex of B.
  void corner(std::uint32_t of_a, std::uint32_t of_b, MinkowskiCorner& c) const {
    Vector3<double> x;
    a.vertex(of_a, c.a);
    b.vertex(of_b, x);
    complete(c, x);
    c.vertex_a = of_a;
    c.vertex_b = of_b;
  }
  /// Sets c to the corner furthest along −d.
  void support_against(const Vector3<double>& d, MinkowskiCorner& c) const {
    Vector3<double> of_b;
    c.vertex_a = a.support(-d, c.a);
    c.vertex_b = b.support(rotation.transpose() * d, of_b);
    complete(c, of_b);
  }
  /// The corner furthest along d.
  MinkowskiCorner support(const Vector3<double>& d) const {
    MinkowskiCorner c;
    support_against(-d, c);
    return c;
  }
  Vector3<double> in_b(const Vector3<double>& turned) const { return rotation.transpose() * turned; }
};

}  // namespace polhode::collision::narrow
