// SPDX-License-Identifier: BSD-3-Clause
#include "tests/collision/narrow/placed_pairs.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/ellipsoid.hpp"
#include "collision/shapes/sphere.hpp"
#include "core/math/portable_random.hpp"

namespace polhode {

namespace {

using Real = long double;
using Vector = Vector3<Real>;
using Matrix = Matrix3<Real>;

using study::Dice;

Vector3<double> bell_vector(Dice& dice) {
  const double x = dice.bell(), y = dice.bell();
  return {x, y, dice.bell()};
}

ShapePointer sphere_hull(Dice& dice, int n, double scale) {
  std::vector<Vector3<double>> points;
  for (int i = 0; i < n; ++i) points.push_back(scale * dice.direction());
  return std::make_shared<ConvexHull>(points);
}

}  // namespace

Pose random_pose(std::uint64_t seed, double spread) {
  Dice dice(seed);
  return {spread * bell_vector(dice), dice.rotation()};
}

PlacedPair hull_pair(std::uint64_t k) {
  Dice dice(k);
  const double scale = dice.power_of_ten(-3, 3), ratio = dice.below(2) ? 1 : dice.power_of_ten(-2, 0);
  const auto count = [&] { return k % 10 == 0 ? 128 : 4 + dice.below(28); };
  const double size_a = scale, size_b = scale * ratio;
  PlacedPair p = {sphere_hull(dice, count(), size_a),
                  sphere_hull(dice, count(), size_b),
                  {scale * bell_vector(dice), dice.rotation()},
                  {},
                  size_a,
                  size_b,
                  true};
  p.at_b = {p.at_a.position + dice.uniform(0, 1) * (size_a + size_b) * dice.direction(), dice.rotation()};
  return p;
}

PlacedPair any_pair(std::uint64_t seed) {
  Dice dice(seed);
  PlacedPair p;
  const auto shape = [&](double scale) -> ShapePointer {
    const Vector3<double> s = scale * dice.uniform_vector(0.1, 1);
    switch (dice.below(7)) {
      case 0: return std::make_shared<Sphere>(s[0]);
      case 1: return std::make_shared<Capsule>(s[0], s[1]);
      case 2: p.polytopes = false; return std::make_shared<Cylinder>(s[0], s[1]);
      case 3: p.polytopes = false; return std::make_shared<Ellipsoid>(s);
      case 4: return sphere_hull(dice, 4 + dice.below(30), scale);
      default: return std::make_shared<Box>(s);
    }
  };
  p.size_a = 1;
  p.size_b = dice.below(2) ? 1 : dice.power_of_ten(-2, 0);
  p.a = shape(p.size_a);
  p.b = shape(p.size_b);
  p.at_a = {bell_vector(dice), dice.rotation()};
  p.at_b = {p.at_a.position + dice.uniform(0, 2) * bell_vector(dice),
            dice.below(3) ? dice.rotation() : p.at_a.rotation};
  if (dice.below(8) == 0) p.at_b.position = p.at_a.position;
  return p;
}

long double separation_of_hulls(const PlacedPair& p) {
  struct Solid {
    std::vector<Vector> vertices, normals, edges;
  };
  const auto solid = [](const ShapePointer& shape, const Pose& at) {
    const Polytope& polytope = static_cast<const ConvexHull&>(*shape).polytope();
    const Matrix r = at.rotation.cast<Real>();
    Solid s;
    for (const auto& v : polytope.vertices) s.vertices.push_back(r * v.cast<Real>() + at.position.cast<Real>());
    for (std::uint32_t f = 0; f < polytope.faces.size(); ++f) {
      const auto c = polytope.corners_of(f);
      const Vector origin = s.vertices[c[0].vertex];
      s.normals.push_back((s.vertices[c[1].vertex] - origin).cross(s.vertices[c[2].vertex] - origin).normalized());
    }
    for (const auto& e : polytope.edges) s.edges.push_back((s.vertices[e.to] - s.vertices[e.from]).normalized());
    return s;
  };
  const Solid a = solid(p.a, p.at_a), b = solid(p.b, p.at_b);
  const auto gap = [](const Solid& low, const Solid& high, const Vector& n, Real stop) {
    Real top = -std::numeric_limits<Real>::infinity(), bottom = -top;
    for (const Vector& v : low.vertices) top = std::max(top, n.dot(v));
    for (const Vector& v : high.vertices) {
      bottom = std::min(bottom, n.dot(v));
      if (bottom - top <= stop) break;
    }
    return bottom - top;
  };
  Real most = -std::numeric_limits<Real>::infinity();
  const auto consider = [&](const Vector& n) {
    most = std::max(most, gap(a, b, n, most));
    most = std::max(most, gap(b, a, n, most));
  };
  for (const Vector& n : a.normals) consider(n);
  for (const Vector& n : b.normals) consider(n);
  for (const Vector& u : a.edges) {
    for (const Vector& v : b.edges) {
      const Vector n = u.cross(v);
      if (n.norm() > 1e-12L) consider(n.normalized());
    }
  }
  return most;
}

}  // namespace polhode
