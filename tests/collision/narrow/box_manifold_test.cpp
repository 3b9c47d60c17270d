// SPDX-License-Identifier: BSD-3-Clause
// Contact patches of two boxes: published contacts, what each point must satisfy on random pairs, and names that stay.
#include "collision/narrow/box_manifold.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "collision/shapes/box.hpp"
#include "core/math/portable_random.hpp"
#include "experiments/narrow_phase/box_pairs.hpp"
#include "tests/collision/narrow/manifold_parts.hpp"

namespace polhode::box_manifold_test {
namespace {

using Vector = Vector3<double>;
using Kind = Feature::Kind;
using study::narrow_phase::BoxPairCase;
using study::narrow_phase::BoxPairs;

PosedBox cube(double half, const Vector& position, const Vector& rotation = Vector::Zero()) {
  return {Vector::Constant(half),
          {position, rotation_matrix<double>(quaternion_from_rotation_vector<double>(rotation))}};
}
BoxAt at(const PosedBox& box) { return {box.half, box.pose}; }
Manifold manifold(const PosedBox& a, const PosedBox& b, double margin = 0) {
  return boxes_manifold(at(a), at(b), margin);
}

TEST(BoxManifold, TiltedCubesKeepAFourPointFaceContact) {
  const Vector axes[] = {Vector(1, 1, 1).normalized(), Vector::UnitX(), Vector::UnitZ(),
                         Vector(1, 0.2, -0.7).normalized()};
  for (const Vector& axis : axes) {
    std::set<FeatureName> before;
    for (double tilt = 0; tilt <= 0.05001; tilt += 0.0005) {
      const Manifold m = manifold(cube(0.5, {0, 0, 0}), cube(0.5, {0.1, 0.99, 0.05}, tilt * axis));
      ASSERT_EQ(m.count, 4u) << tilt << " about " << axis.transpose();
      EXPECT_LT(m.normal.y(), -0.99);
      EXPECT_GE(deepest(m), 0.0099);
      if (tilt > 0.0005) {
        EXPECT_EQ(names(m), before) << tilt << " about " << axis.transpose();
      }
      before = names(m);
    }
  }
}

TEST(BoxManifold, AFaceTurnedBy45DegreesIsAnOctagon) {
  const Manifold m = manifold(cube(1, {0, 0, 0}), cube(1, {0, 0, 1.999}, {0, 0, std::numbers::pi / 4}));
  ASSERT_EQ(m.count, 8u);
  EXPECT_NEAR((m.normal - Vector(0, 0, -1)).norm(), 0, 1e-15);
  for (std::size_t k = 0; k < 8; ++k) {
    const ContactPoint& p = m.points[k];
    EXPECT_EQ(p.feature.kind, Kind::edge_edge);
    EXPECT_NEAR(p.depth, 0.001, 1e-12);
    EXPECT_NEAR(p.point.z(), 0.9995, 1e-12);
    const double small = std::min(std::abs(p.point.x()), std::abs(p.point.y())),
                 large = std::max(std::abs(p.point.x()), std::abs(p.point.y()));
    EXPECT_NEAR(large, 1, 1e-12);
    EXPECT_NEAR(small, std::numbers::sqrt2 - 1, 1e-12);
  }
  EXPECT_EQ(names(m).size(), 8u);
}

TEST(BoxManifold, EachKindOfContactHasItsName) {
  const PosedBox a = cube(1, {0, 0, 0});
  const Vector edge_up(std::numbers::pi / 4, 0, 0);
  const Manifold edge_on_face = manifold(a, cube(1, {0, 0, 1 + std::numbers::sqrt2 - 0.001}, edge_up));
  ASSERT_EQ(edge_on_face.count, 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(edge_on_face.points[k].feature.kind, Kind::face_vertex);
    EXPECT_EQ(edge_on_face.points[k].feature.of_a, 5u);
    EXPECT_NEAR(edge_on_face.points[k].depth, 0.001, 1e-12);
  }
  PosedBox on_a_vertex = cube(1, {0, 0, 2.7310508075688773});
  on_a_vertex.pose.rotation =
      rotation_matrix<double>({0.45970084338098305, 0.6279630301995544, -0.6279630301995544, 0});
  const Manifold vertex_on_face = manifold(a, on_a_vertex);
  ASSERT_EQ(vertex_on_face.count, 1u);
  EXPECT_EQ(vertex_on_face.points[0].feature.kind, Kind::face_vertex);
  EXPECT_NEAR(vertex_on_face.points[0].depth, 0.001, 1e-12);
  EXPECT_NEAR((vertex_on_face.points[0].point - Vector(0, 0, 0.9995)).norm(), 0, 1e-9);
  const Manifold other_way = manifold(on_a_vertex, a);
  EXPECT_EQ(other_way.points[0].feature.kind, Kind::vertex_face);
  EXPECT_EQ(other_way.points[0].feature.of_b, 5u);
  // Two edges crossed at right angles, 0.001 deep.
  PosedBox below = cube(1, {0, 0, 0}, {std::numbers::pi / 4, 0, 0});
  PosedBox above = cube(1, {0.1, 0.2, 2 * std::numbers::sqrt2 - 0.001}, {0, std::numbers::pi / 4, 0});
  above.half = below.half = {3, 1, 1};
  std::swap(above.half[0], above.half[1]);
  const Manifold edges = manifold(below, above);
  ASSERT_EQ(edges.count, 1u);
  EXPECT_EQ(edges.points[0].feature.kind, Kind::edge_edge);
  EXPECT_NEAR(edges.points[0].depth, 0.001, 1e-12);
  EXPECT_NEAR((edges.points[0].point - Vector(0.1, 0, std::numbers::sqrt2 - 0.0005)).norm(), 0, 1e-12);
}

TEST(BoxManifold, NumbersAreThoseOfThePolytope) {
  BoxPairs make(12);
  std::set<Kind> seen;
  for (std::uint64_t k = 0; k < 4000; ++k) {
    const BoxPairCase pair = make(k);
    const PosedBox a{pair.a.half, {pair.a.position, rotation_matrix<double>(pair.a.orientation)}};
    const PosedBox b{pair.b.half, {pair.b.position, rotation_matrix<double>(pair.b.orientation)}};
    const Box shape_a(a.half), shape_b(b.half);
    const Manifold m = manifold(a, b);
    const double tolerance = 1e-5 * std::max(a.half.maxCoeff(), b.half.maxCoeff());
    for (std::size_t i = 0; i < m.count; ++i) {
      const auto& [point, depth, feature] = m.points[i];
      const Vector on_a = point - 0.5 * depth * m.normal, on_b = point + 0.5 * depth * m.normal;
      const auto off_vertex = [&](const PosedBox& box, const Polytope& p, std::uint32_t vertex, const Vector& x) {
        return (p.vertices[vertex] - box.pose.to_body(x)).norm();
      };
      const auto off_edge = [&](const PosedBox& box, const Polytope& p, std::uint32_t edge, const Vector& x) {
        const Vector from = p.vertices[p.edges[edge].from], along = (p.vertices[p.edges[edge].to] - from).normalized();
        return (box.pose.to_body(x) - from).cross(along).norm();
      };
      seen.insert(feature.kind);
      switch (feature.kind) {
        case Kind::vertex_face:
          ASSERT_LE(off_vertex(a, shape_a.polytope(), feature.of_a, on_a), tolerance + std::abs(depth)) << k;
          break;
        case Kind::face_vertex:
          ASSERT_LE(off_vertex(b, shape_b.polytope(), feature.of_b, on_b), tolerance + std::abs(depth)) << k;
          break;
        case Kind::edge_edge:
          ASSERT_LE(off_edge(a, shape_a.polytope(), feature.of_a, on_a), tolerance) << pair.what << k;
          ASSERT_LE(off_edge(b, shape_b.polytope(), feature.of_b, on_b), tolerance) << pair.what << k;
          break;
        default: break;
      }
    }
  }
  EXPECT_TRUE(seen.contains(Kind::vertex_face) && seen.contains(Kind::face_vertex) && seen.contains(Kind::edge_edge));
}

TEST(BoxManifold, FacesThatTouchButForRoundOffHaveTheWholePatch) {
  PortableRandom random(5);
  int touching = 0;
  for (int k = 0; k < 1000; ++k) {
    PosedBox a{random.uniform_vector(0.5, 1.5), {random.uniform_vector(-1, 1), random.rotation()}},
        b{random.uniform_vector(0.5, 1.5), a.pose};
    b.pose.position = a.pose.to_world({random.uniform(-0.5, 0.5), a.half[1] + b.half[1], random.uniform(-0.5, 0.5)});
    const Manifold m = manifold(a, b);
    if (m.count == 0) continue;
    ++touching;
    ASSERT_EQ(m.count, 4u) << k;
    ASSERT_NEAR(deepest(m), 0, 2e-15) << k;
  }
  EXPECT_GT(touching, 300);
}

TEST(BoxManifold, EveryOverlappingPairHasOneAndItIsAsDeepAsTheyAre) {
  BoxPairs make(11);
  int contacts = 0, others = 0;
  for (std::uint64_t k = 0; k < 10000; ++k) {
    const BoxPairCase pair = make(k);
    const PosedBox a{pair.a.half, {pair.a.position, rotation_matrix<double>(pair.a.orientation)}};
    const PosedBox b{pair.b.half, {pair.b.position, rotation_matrix<double>(pair.b.orientation)}};
    const double smaller = std::min(a.half.minCoeff(), b.half.minCoeff());
    const double margin = k % 3 == 0 ? 0.1 * smaller : 0;
    const Distance d = boxes_distance(at(a), at(b));
    const Manifold m = manifold(a, b, margin);
    ASSERT_EQ(m.count > 0, d.distance <= margin) << pair.what << k;
    if (m.count == 0) continue;
    ++contacts;
    ASSERT_LE(m.count, Manifold::capacity);
    ASSERT_EQ(names(m).size(), m.count) << pair.what << k;
    ASSERT_NEAR(m.normal.norm(), 1, 1e-14);
    // An axis with a little less depth may give way to a face that is almost as good.
    ASSERT_GE(deepest(m), d.distance > 0 ? -margin : -d.distance - 1e-9 * smaller) << pair.what << k;
    if (m.normal.dot(d.normal) > 1 - 1e-15) {
      ASSERT_LE(deepest(m), -d.distance + 1e-9 * smaller) << pair.what << k;
    }
    for (std::size_t i = 0; i < m.count; ++i) others += m.points[i].feature.kind == Kind::other;
    const Manifold mirrored = manifold(b, a, margin);
    ASSERT_EQ(mirrored.count, m.count);
    if (a.half == b.half && a.pose.position == b.pose.position && a.pose.rotation == b.pose.rotation) continue;
    ASSERT_EQ(mirrored.normal, -m.normal);
    for (std::size_t i = 0; i < m.count; ++i) {
      ASSERT_EQ(mirrored.points[i].point, m.points[i].point);
      ASSERT_EQ(mirrored.points[i].depth, m.points[i].depth);
      ASSERT_EQ(mirrored.points[i].feature.of_a, m.points[i].feature.of_b);
    }
  }
  EXPECT_GT(contacts, 4000);
  EXPECT_LT(others, contacts / 20);
}

}  // namespace
}  // namespace polhode::box_manifold_test
