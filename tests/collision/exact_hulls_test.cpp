// SPDX-License-Identifier: BSD-3-Clause
// The judge of hulls itself: what is known, boxes beside the judge of boxes, hulls beside all directions of their features.
#include "tests/collision/exact_hulls.hpp"

#include <gtest/gtest.h>

#include "experiments/narrow_phase/box_pairs.hpp"
#include "tests/collision/hull_pairs.hpp"

namespace polhode {
namespace {

using Vector = Vector3<double>;
using Real = long double;

ExactHull box(const Vector& half, const Pose& pose = {}) {
  ExactHull hull{{}, pose};
  for (int k = 0; k < 8; ++k) hull.points.push_back(half.cwiseProduct(Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return hull;
}

TEST(ExactHulls, KnowsWhatIsKnown) {
  const ExactHull cube = box({0.5, 0.5, 0.5});
  ExactHull other = cube;
  EXPECT_EQ(exact_distance(cube, other).sign, -1);
  EXPECT_EQ(exact_distance(cube, other).distance, -1);
  other.pose.position = {1, 0, 0};
  EXPECT_EQ(exact_distance(cube, other).sign, 0);
  EXPECT_EQ(exact_distance(cube, other).distance, 0);
  other.pose.position = {1, 1, 1};
  EXPECT_EQ(exact_distance(cube, other).sign, 0);
  other.pose.position = {1 + 0x1p-52, 0, 0};
  EXPECT_EQ(exact_distance(cube, other).sign, 1);
  EXPECT_EQ(exact_distance(cube, other).distance, 0x1p-52);
  other.pose.position = {1 - 0x1p-53, 0.3, 0};
  EXPECT_EQ(exact_distance(cube, other).sign, -1);
  EXPECT_EQ(exact_distance(cube, other).distance, -0x1p-53);
  other.pose.position = {3, 4, 0};
  EXPECT_EQ(exact_distance(cube, other).distance, std::sqrt(4.0L + 9));
  const ExactHull tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 0, 0.5}}};
  EXPECT_EQ(exact_distance(cube, tetrahedron).sign, 0);
  EXPECT_EQ(exact_distance(box({1, 1, 1}), tetrahedron).distance, -0.5);
  EXPECT_EQ(exact_distance(ExactHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}}, ExactHull{tetrahedron.points, {{1, 1, 1}}}).distance,
            2 / std::sqrt(3.0L));
}

TEST(ExactHulls, FlatOnesAreRefused) {
  const ExactHull flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}};
  EXPECT_THROW((void)exact_distance(flat, flat), std::invalid_argument);
}

// The rotation of a quaternion is rounded before this judge sees it.
TEST(ExactHulls, SayOfBoxesWhatTheJudgeOfBoxesSays) {
  BoxPairs make(6);
  for (std::uint64_t k = 0; k < 800; ++k) {
    const BoxPairCase pair = make(k);
    const auto posed = [](const ExactBox& b) { return box(b.half, {b.position, rotation_matrix<double>(b.orientation)}); };
    const ExactDistance d = exact_distance(posed(pair.a), posed(pair.b)), expected = exact_distance(pair.a, pair.b);
    const long double rounding = 4e-16L * (pair.a.half.norm() + pair.b.half.norm());
    ASSERT_LE(std::abs(d.distance - expected.distance), rounding) << k << " " << pair.what;
    if (std::abs(expected.distance) > rounding) {
      ASSERT_EQ(d.sign, expected.sign) << k << " " << pair.what;
    }
  }
}

/// The largest separation along all normals of faces and products of edges, in long double.
Real separation_of_hulls(const HullPairCase& pair) {
  struct Solid {
    std::vector<Vector3<Real>> vertices, normals, edges;
  };
  const auto solid = [](const ConvexHull& hull, const Pose& at) {
    const Polytope& polytope = hull.polytope();
    const Matrix3<Real> r = at.rotation.cast<Real>();
    Solid s;
    for (const auto& v : polytope.vertices) s.vertices.push_back(r * v.cast<Real>() + at.position.cast<Real>());
    for (std::uint32_t f = 0; f < polytope.faces.size(); ++f) {
      const auto c = polytope.corners_of(f);
      const Vector3<Real> origin = s.vertices[c[0].vertex];
      s.normals.push_back((s.vertices[c[1].vertex] - origin).cross(s.vertices[c[2].vertex] - origin).normalized());
    }
    for (const auto& e : polytope.edges) s.edges.push_back((s.vertices[e.to] - s.vertices[e.from]).normalized());
    return s;
  };
  const Solid a = solid(*pair.a, pair.at_a), b = solid(*pair.b, pair.at_b);
  const auto gap = [](const Solid& low, const Solid& high, const Vector3<Real>& n, Real stop) {
    Real top = -std::numeric_limits<Real>::infinity(), bottom = -top;
    for (const Vector3<Real>& v : low.vertices) top = std::max(top, n.dot(v));
    for (const Vector3<Real>& v : high.vertices) {
      bottom = std::min(bottom, n.dot(v));
      if (bottom - top <= stop) break;
    }
    return bottom - top;
  };
  Real most = -std::numeric_limits<Real>::infinity();
  const auto consider = [&](const Vector3<Real>& n) {
    most = std::max(most, gap(a, b, n, most));
    most = std::max(most, gap(b, a, n, most));
  };
  for (const Vector3<Real>& n : a.normals) consider(n);
  for (const Vector3<Real>& n : b.normals) consider(n);
  for (const Vector3<Real>& u : a.edges) {
    for (const Vector3<Real>& v : b.edges) {
      const Vector3<Real> n = u.cross(v);
      if (n.norm() > 1e-12L) consider(n.normalized());
    }
  }
  return most;
}

TEST(ExactHulls, SayWhatAllDirectionsOfTheirFeaturesSay) {
  for (std::uint64_t k = 0; k < 240; ++k) {
    const HullPairCase pair = hull_pair_case(4, k);
    if (pair.a->polytope().edges.size() * pair.b->polytope().edges.size() > 5000) continue;
    const ExactDistance d = exact_distance(ExactHull{pair.points_a, pair.at_a}, ExactHull{pair.points_b, pair.at_b});
    const Real separation = separation_of_hulls(pair);
    const double size = std::max(pair.a->bounds({}).sizes().maxCoeff(), pair.b->bounds({}).sizes().maxCoeff());
    // qhull leaves out a vertex that it cannot tell from a face.
    if (d.sign > 0) {
      ASSERT_GE(d.distance, separation - 2e-15 * size) << k << " " << pair.what;
    } else {
      ASSERT_NEAR(double(d.distance), double(separation), 2e-15 * size) << k << " " << pair.what;
    }
  }
}

TEST(ExactHulls, MirrorAndKnowEveryClass) {
  std::size_t apart = 0, touching = 0, overlapping = 0;
  for (std::uint64_t k = 0; k < 330; ++k) {
    const HullPairCase pair = hull_pair_case(1, k);
    const ExactHull a{pair.points_a, pair.at_a}, b{pair.points_b, pair.at_b};
    const ExactDistance d = exact_distance(a, b), mirrored = exact_distance(b, a);
    ASSERT_EQ(d.sign, mirrored.sign) << k << " " << pair.what;
    ASSERT_NEAR(double(d.distance), double(mirrored.distance), 1e-17 * std::abs(double(d.distance))) << k << " " << pair.what;
    (d.sign > 0 ? apart : d.sign < 0 ? overlapping : touching) += 1;
  }
  EXPECT_GT(apart, 100u);
  EXPECT_GT(overlapping, 100u);
  EXPECT_GE(touching, 4u);
}

}  // namespace
}  // namespace polhode
