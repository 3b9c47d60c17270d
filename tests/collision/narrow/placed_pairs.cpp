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
namespace placed_pairs {
namespace {

Vector3<double> bell_vector(PortableRandom& random) {
  const double x = random.bell(), y = random.bell();
  return {x, y, random.bell()};
}

ShapePointer sphere_hull(PortableRandom& random, int n, double scale) {
  std::vector<Vector3<double>> points;
  for (int i = 0; i < n; ++i) points.push_back(scale * random.direction());
  return std::make_shared<ConvexHull>(points);
}

}  // namespace
}  // namespace placed_pairs

Pose random_pose(std::uint64_t seed, double spread) {
  using namespace placed_pairs;
  PortableRandom random(seed);
  return {spread * bell_vector(random), random.rotation()};
}

PlacedPair hull_pair(std::uint64_t k) {
  using namespace placed_pairs;
  PortableRandom random(k);
  const double scale = random.power_of_ten(-3, 3), ratio = random.below(2) ? 1 : random.power_of_ten(-2, 0);
  const auto count = [&] { return k % 10 == 0 ? 128 : 4 + random.below(28); };
  const double size_a = scale, size_b = scale * ratio;
  PlacedPair p = {sphere_hull(random, count(), size_a),
                  sphere_hull(random, count(), size_b),
                  {scale * bell_vector(random), random.rotation()},
                  {},
                  size_a,
                  size_b,
                  true};
  p.at_b = {p.at_a.position + random.uniform(0, 1) * (size_a + size_b) * random.direction(), random.rotation()};
  return p;
}

PlacedPair any_pair(std::uint64_t seed) {
  using namespace placed_pairs;
  PortableRandom random(seed);
  PlacedPair p;
  const auto shape = [&](double scale) -> ShapePointer {
    const Vector3<double> s = scale * random.uniform_vector(0.1, 1);
    switch (random.below(7)) {
      case 0: return std::make_shared<Sphere>(s[0]);
      case 1: return std::make_shared<Capsule>(s[0], s[1]);
      case 2: p.polytopes = false; return std::make_shared<Cylinder>(s[0], s[1]);
      case 3: p.polytopes = false; return std::make_shared<Ellipsoid>(s);
      case 4: return sphere_hull(random, 4 + random.below(30), scale);
      default: return std::make_shared<Box>(s);
    }
  };
  p.size_a = 1;
  p.size_b = random.below(2) ? 1 : random.power_of_ten(-2, 0);
  p.a = shape(p.size_a);
  p.b = shape(p.size_b);
  p.at_a = {bell_vector(random), random.rotation()};
  p.at_b = {p.at_a.position + random.uniform(0, 2) * bell_vector(random),
            random.below(3) ? random.rotation() : p.at_a.rotation};
  if (random.below(8) == 0) p.at_b.position = p.at_a.position;
  return p;
}

long double separation_of_hulls(const PlacedPair& p) {
  using Vector = Vector3<long double>;
  using Matrix = Matrix3<long double>;
  struct Solid {
    std::vector<Vector> vertices, normals, edges;
  };
  const auto solid = [](const ShapePointer& shape, const Pose& at) {
    const Polytope& polytope = static_cast<const ConvexHull&>(*shape).polytope();
    const Matrix r = at.rotation.cast<long double>();
    Solid s;
    for (const auto& v : polytope.vertices)
      s.vertices.push_back(r * v.cast<long double>() + at.position.cast<long double>());
    for (std::uint32_t f = 0; f < polytope.faces.size(); ++f) {
      const auto c = polytope.corners_of(f);
      const Vector origin = s.vertices[c[0].vertex];
      s.normals.push_back((s.vertices[c[1].vertex] - origin).cross(s.vertices[c[2].vertex] - origin).normalized());
    }
    for (const auto& e : polytope.edges) s.edges.push_back((s.vertices[e.to] - s.vertices[e.from]).normalized());
    return s;
  };
  const Solid a = solid(p.a, p.at_a), b = solid(p.b, p.at_b);
  const auto gap = [](const Solid& low, const Solid& high, const Vector& n, long double stop) {
    long double top = -std::numeric_limits<long double>::infinity(), bottom = -top;
    for (const Vector& v : low.vertices) top = std::max(top, n.dot(v));
    for (const Vector& v : high.vertices) {
      bottom = std::min(bottom, n.dot(v));
      if (bottom - top <= stop) break;
    }
    return bottom - top;
  };
  long double most = -std::numeric_limits<long double>::infinity();
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
