// SPDX-License-Identifier: BSD-3-Clause
#include "tests/collision/placed_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/ellipsoid.hpp"
#include "collision/shapes/sphere.hpp"

namespace polhode {

namespace {

using Real = long double;
using Vector = Vector3<Real>;
using Matrix = Matrix3<Real>;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * (double(random_() >> 11) * 0x1p-53); }
  int whole(int n) { return int(random_() % std::uint64_t(n)); }
  Vector3<double> bell() { return {normal_(random_), normal_(random_), normal_(random_)}; }
  Matrix3<double> rotation() {
    return rotation_matrix(Quaternion<double>(normal_(random_), normal_(random_), normal_(random_), normal_(random_)));
  }
  Vector3<double> sizes(double scale) { return scale * Vector3<double>(uniform(0.1, 1), uniform(0.1, 1), uniform(0.1, 1)); }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

struct RealBox {
  Vector half, position;
  Matrix axes;
};

RealBox real_box(const ShapePointer& shape, const Pose& at) {
  return {static_cast<const Box&>(*shape).half_extents().cast<Real>(), at.position.cast<Real>(), at.rotation.cast<Real>()};
}

Real separation(const RealBox& a, const RealBox& b, const Vector& n) {
  return n.dot(b.position - a.position) - (a.axes.transpose() * n).cwiseAbs().dot(a.half) -
         (b.axes.transpose() * n).cwiseAbs().dot(b.half);
}

Real point_to_box(const Vector& x, const RealBox& box) {
  const Vector inside = (box.axes.transpose() * (x - box.position)).cwiseAbs() - box.half;
  return inside.cwiseMax(Vector::Zero()).norm();
}

/// Both from p over d. Ends and the crossing of the lines are points of the segments, so that none is too near.
Real segment_to_segment(const Vector& p1, const Vector& d1, const Vector& p2, const Vector& d2) {
  const Vector r = p1 - p2;
  const Real a = d1.dot(d1), b = d1.dot(d2), c = d1.dot(r), e = d2.dot(d2), f = d2.dot(r), area = d1.cross(d2).squaredNorm();
  const auto share = [](Real x) { return std::clamp(x, Real(0), Real(1)); };
  Real best = std::numeric_limits<Real>::infinity();
  const auto consider = [&](Real s, Real t) { best = std::min(best, (p1 + s * d1 - p2 - t * d2).norm()); };
  for (int end = 0; end < 2; ++end) {
    consider(end, share((b * Real(end) + f) / e));
    consider(share((b * Real(end) - c) / a), end);
  }
  if (area > 0) {
    const Real s = share((b * f - c * e) / area);
    consider(s, share((b * s + f) / e));
  }
  return best;
}

Real signed_distance(const RealBox& a, const RealBox& b) {
  Real most = -std::numeric_limits<Real>::infinity();
  const auto consider = [&](const Vector& n) {
    const Real length = n.norm();
    if (length < 1e-17L) return;
    most = std::max({most, separation(a, b, Vector(n / length)), separation(a, b, Vector(n / -length))});
  };
  for (int i = 0; i < 3; ++i) {
    consider(a.axes.col(i));
    consider(b.axes.col(i));
    for (int j = 0; j < 3; ++j) consider(a.axes.col(i).cross(b.axes.col(j)));
  }
  if (most <= 0) return most;
  Real least = std::numeric_limits<Real>::infinity();
  const auto corners = [](const RealBox& box, const RealBox& other, Real& nearest) {
    for (int k = 0; k < 8; ++k) {
      Vector x = box.position;
      for (int i = 0; i < 3; ++i) x += box.axes.col(i) * (k >> i & 1 ? box.half[i] : -box.half[i]);
      nearest = std::min(nearest, point_to_box(x, other));
    }
  };
  corners(a, b, least);
  corners(b, a, least);
  const auto edges = [](const RealBox& box) {
    std::vector<std::array<Vector, 2>> all;
    for (int axis = 0; axis < 3; ++axis) {
      const int j = (axis + 1) % 3, k = (axis + 2) % 3;
      for (int side = 0; side < 4; ++side) {
        all.push_back({Vector(box.position - box.axes.col(axis) * box.half[axis] +
                              box.axes.col(j) * (side & 1 ? box.half[j] : -box.half[j]) +
                              box.axes.col(k) * (side & 2 ? box.half[k] : -box.half[k])),
                       Vector(box.axes.col(axis) * (2 * box.half[axis]))});
      }
    }
    return all;
  };
  const auto edges_b = edges(b);
  for (const auto& [p1, d1] : edges(a)) {
    for (const auto& [p2, d2] : edges_b) least = std::min(least, segment_to_segment(p1, d1, p2, d2));
  }
  return least;
}

ShapePointer sphere_hull(Dice& dice, int n, double scale) {
  std::vector<Vector3<double>> points;
  for (int i = 0; i < n; ++i) points.push_back(scale * dice.bell().normalized());
  return std::make_shared<ConvexHull>(points);
}

}  // namespace

Pose random_pose(std::uint64_t seed, double spread) {
  Dice dice(seed);
  return {spread * dice.bell(), dice.rotation()};
}

PlacedPair box_pair(std::uint64_t k) {
  Dice dice(k);
  const int kind = int(k % 7);
  const double scale = std::pow(10, dice.uniform(-3, 3)), ratio = dice.whole(2) ? 1 : std::pow(10, dice.uniform(-4, 0));
  Vector3<double> half_a = dice.sizes(scale), half_b = dice.sizes(scale * ratio);
  if (dice.whole(4) == 0) half_a[dice.whole(3)] *= std::pow(10, dice.uniform(-3, 0));
  if (dice.whole(2)) std::swap(half_a, half_b);
  const double size = std::max(half_a.maxCoeff(), half_b.maxCoeff());
  PlacedPair p = {std::make_shared<Box>(half_a), std::make_shared<Box>(half_b), {size * dice.bell(), dice.rotation()},
                  {Vector3<double>::Zero(), dice.rotation()}, half_a.maxCoeff(), half_b.maxCoeff(), true};
  const auto about = [](const Vector3<double>& v) { return rotation_matrix(quaternion_from_rotation_vector<double>(v)); };
  const Vector3<double> any = dice.bell().normalized();
  Vector3<double> along = any;
  constexpr double quarter = std::numbers::pi / 2;
  if (kind >= 1 && kind <= 4) {
    Matrix3<double> turn = about(dice.whole(4) * quarter * Vector3<double>::Unit(dice.whole(3)));
    if (kind == 2) turn = about(std::pow(10, dice.uniform(-16, -1)) * any);
    if (kind == 3) turn = about(quarter / 2 * Vector3<double>::Unit(dice.whole(3)));
    if (kind == 4) turn = about(std::acos(1 / std::sqrt(3.0)) * Vector3<double>(1, -1, 0).normalized());
    p.at_b.rotation = p.at_a.rotation * turn;
    along = p.at_a.rotation * Vector3<double>(kind == 3 ? Vector3<double>(1, dice.whole(2), 0).normalized()
                                                        : Vector3<double>(Vector3<double>::Unit(dice.whole(3))));
  }
  p.at_b.position = p.at_a.position;
  if (kind == 5) {
    if (dice.whole(5) > 0) p.at_b.position += dice.uniform(0, 0.3) * size * any;
    return p;
  }
  // Where the two touch along the line, then a gap or an overlap from there.
  double low = 0, high = 20 * size;
  RealBox a = real_box(p.a, p.at_a), b = real_box(p.b, p.at_b);
  for (int i = 0; i < 55; ++i) {
    const double middle = (low + high) / 2;
    b.position = (p.at_a.position + middle * along).cast<Real>();
    (signed_distance(a, b) > 0 ? high : low) = middle;
  }
  constexpr std::array<double, 13> gaps = {0, 1e-15, -1e-15, 1e-13, -1e-13, 1e-9, -1e-9, 1e-4, -1e-4, 0.1, -0.1, -0.3, 1};
  const double gap = kind == 6 ? dice.uniform(0, 100) : kind == 0 ? dice.uniform(-1, 1) : gaps[std::size_t(dice.whole(13))];
  p.at_b.position += (high + gap * size) * along;
  if (const int aside = dice.whole(3); aside > 0 && (kind == 1 || kind == 2)) {
    p.at_b.position += (aside == 1 ? 1 : 0.1) * size * along.cross(dice.bell());
  }
  return p;
}

PlacedPair hull_pair(std::uint64_t k) {
  Dice dice(k);
  const double scale = std::pow(10, dice.uniform(-3, 3)), ratio = std::pow(10, dice.whole(2) ? 0 : dice.uniform(-2, 0));
  const auto count = [&] { return k % 10 == 0 ? 128 : 4 + dice.whole(28); };
  const double size_a = scale, size_b = scale * ratio;
  PlacedPair p = {sphere_hull(dice, count(), size_a), sphere_hull(dice, count(), size_b),
                  {scale * dice.bell(), dice.rotation()}, {}, size_a, size_b, true};
  p.at_b = {p.at_a.position + dice.uniform(0, 1) * (size_a + size_b) * dice.bell().normalized(), dice.rotation()};
  return p;
}

PlacedPair any_pair(std::uint64_t seed) {
  Dice dice(seed);
  PlacedPair p;
  const auto shape = [&](double scale) -> ShapePointer {
    const Vector3<double> s = dice.sizes(scale);
    switch (dice.whole(7)) {
      case 0: return std::make_shared<Sphere>(s[0]);
      case 1: return std::make_shared<Capsule>(s[0], s[1]);
      case 2: p.polytopes = false; return std::make_shared<Cylinder>(s[0], s[1]);
      case 3: p.polytopes = false; return std::make_shared<Ellipsoid>(s);
      case 4: return sphere_hull(dice, 4 + dice.whole(30), scale);
      default: return std::make_shared<Box>(s);
    }
  };
  p.size_a = 1;
  p.size_b = dice.whole(2) ? 1 : std::pow(10, dice.uniform(-2, 0));
  p.a = shape(p.size_a);
  p.b = shape(p.size_b);
  p.at_a = {dice.bell(), dice.rotation()};
  p.at_b = {p.at_a.position + dice.uniform(0, 2) * dice.bell(), dice.whole(3) ? dice.rotation() : p.at_a.rotation};
  if (dice.whole(8) == 0) p.at_b.position = p.at_a.position;
  return p;
}

long double signed_distance_of_boxes(const PlacedPair& p) {
  return signed_distance(real_box(p.a, p.at_a), real_box(p.b, p.at_b));
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
