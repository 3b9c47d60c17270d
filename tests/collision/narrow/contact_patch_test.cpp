// SPDX-License-Identifier: BSD-3-Clause
// Contact patches of all pairs of shapes: what stands and lies on what, and names that stay.
#include "collision/narrow/contact_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/half_space.hpp"
#include "core/math/portable_random.hpp"
#include "core/math/quaternion.hpp"
#include "tests/collision/narrow/manifold_parts.hpp"

namespace polhode::contact_patch_test {
namespace {

using Vector = Vector3<double>;
using Kind = Feature::Kind;

const NarrowPhase& phase(const char* name) {
  static const auto gjk = find_narrow_phase("gjk")->make(), sat = find_narrow_phase("sat")->make();
  return name == std::string("sat") ? *sat : *gjk;
}
const NarrowPhase& gjk() { return phase("gjk"); }

Pose at(const Vector& position, const Vector& turn = Vector::Zero()) {
  return {position, rotation_matrix<double>(quaternion_from_rotation_vector<double>(turn))};
}

/// True if some point of the manifold is at that place.
bool has(const Manifold& m, const Vector& point, double tolerance = 1e-12) {
  for (std::size_t k = 0; k < m.count; ++k) {
    if ((m.points[k].point - point).norm() <= tolerance) return true;
  }
  return false;
}

ConvexHull hull_of(const std::vector<Vector>& points) { return ConvexHull(points); }

ConvexHull cube_hull(double half) {
  std::vector<Vector> points;
  for (int k = 0; k < 8; ++k) points.emplace_back(k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half);
  return hull_of(points);
}

ConvexHull prism(int sides, double radius, double half) {
  std::vector<Vector> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    for (const double z : {-half, half}) points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return hull_of(points);
}

const Vector on_side(0, std::numbers::pi / 2, 0);  // turns axis 3 to axis 1

TEST(ContactPatch, WhatStandsOnAFloorTouchesWithAllItsCorners) {
  const HalfSpace floor(Vector(0, 0, 1));
  const Box box({1, 2, 3});
  const ConvexHull hull = cube_hull(1);
  const Manifold of_box = gjk().manifold(box, at({5, 6, 2.999}), floor, {});
  ASSERT_EQ(of_box.count, 4u);
  EXPECT_EQ(of_box.normal, Vector(0, 0, 1));
  for (const double x : {4.0, 6.0}) {
    for (const double y : {4.0, 8.0}) EXPECT_TRUE(has(of_box, {x, y, -0.0005}));
  }
  EXPECT_EQ(
      names(of_box),
      (std::set<FeatureName>{
          {Kind::vertex_face, 0, 0}, {Kind::vertex_face, 1, 0}, {Kind::vertex_face, 2, 0}, {Kind::vertex_face, 3, 0}}));
  const Manifold of_hull = gjk().manifold(floor, {}, hull, at({5, 6, 0.9}));
  ASSERT_EQ(of_hull.count, 4u);
  EXPECT_EQ(of_hull.normal, Vector(0, 0, -1));
  EXPECT_NEAR(deepest(of_hull), 0.1, 1e-15);
  // A box on an edge, and on a corner.
  const Manifold on_edge = gjk().manifold(box, at({0, 0, 1}, {std::numbers::pi / 4, 0, 0}), floor, {});
  ASSERT_EQ(on_edge.count, 2u);
  const Manifold on_corner = gjk().manifold(box, at({0, 0, 3.5}, {0.5, 0.4, 0}), floor, {});
  ASSERT_EQ(on_corner.count, 1u);
  EXPECT_EQ(on_corner.points[0].feature.kind, Kind::vertex_face);
}

TEST(ContactPatch, AFloorMayBeAskew) {
  const Vector up = Vector(1, 2, 3).normalized();
  const HalfSpace floor(up, 0.5);
  const Box box({1, 2, 3});
  Pose pose;
  pose.rotation.col(2) = up;
  pose.rotation.col(0) = up.cross(Vector::UnitX()).normalized();
  pose.rotation.col(1) = up.cross(pose.rotation.col(0));
  pose.position = Vector(7, 8, 9);
  pose.position += (0.5 + 2.99 - up.dot(pose.position)) * up;
  const Manifold m = gjk().manifold(box, pose, floor, {});
  ASSERT_EQ(m.count, 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(m.points[k].depth, 0.01, 1e-14);
}

TEST(ContactPatch, BoxesHaveTheSamePointsFromGjkAndSat) {
  const Box a({1, 1, 1}), b({0.5, 0.7, 0.4});
  for (const Pose& pose :
       {at({0.2, 0.1, 1.39}), at({0.8, 0.6, 1.39}, {0, 0, 0.3}), at({0.2, 0.1, 1.395}, {0.02, -0.01, 0.4}),
        at({-1.45, 0.3, 0.2}, {0.03, 0, 0}), at({0, 0, 1.39}, {0, 0, std::numbers::pi / 4})}) {
    const Manifold one = gjk().manifold(a, {}, b, pose), other = phase("sat").manifold(a, {}, b, pose);
    ASSERT_GE(one.count, 4u);
    EXPECT_EQ(names(one), names(other)) << pose.position.transpose();
    EXPECT_LE((one.normal - other.normal).norm(), 1e-12);
    for (std::size_t k = 0; k < one.count; ++k)
      EXPECT_TRUE(has(other, one.points[k].point)) << pose.position.transpose();
    EXPECT_NEAR(deepest(one), deepest(other), 1e-12);
  }
}

/// However one face lies on the other: turned, tilted, covered in part; the one's corners within, the other's, or all
/// cut off.
TEST(ContactPatch, FacesOfBoxesAreClippedAlikeByGjkAndSat) {
  PortableRandom random(3);
  std::set<std::size_t> counts;
  int alike = 0;
  for (int k = 0; k < 3000; ++k) {
    const Box a(random.uniform_vector(0.5, 1.5)), b(random.uniform_vector(0.3, 1.5));
    const int axis = random.below(3);
    const Vector up = (random.chance(0.5) ? 1 : -1) * Vector::Unit(axis);
    Pose pose = at({}, random.uniform_vector(-0.02, 0.02));
    pose.rotation = pose.rotation * at({}, random.angle() * up).rotation *
                    at({}, std::numbers::pi / 2 * random.below(2) * Vector::Unit((axis + 1) % 3)).rotation;
    pose.position = random.uniform_vector(-1.5, 1.5);
    pose.position[axis] = 0;
    pose.position +=
        up * (a.support(up) - pose.rotation * b.support(pose.rotation.transpose() * -up)).dot(up) - 0.01 * up;
    const Manifold one = gjk().manifold(a, {}, b, pose), other = phase("sat").manifold(a, {}, b, pose);
    if (one.count < 3 || !(one.normal.dot(other.normal) > 1 - 1e-15))
      continue;  // an edge, or the other face, is as good
    ++alike;
    ASSERT_EQ(names(one), names(other)) << k;
    for (std::size_t i = 0; i < one.count; ++i) ASSERT_TRUE(has(other, one.points[i].point)) << k;
    ASSERT_NEAR(deepest(one), deepest(other), 1e-12) << k;
    counts.insert(one.count);
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{3, 4, 5, 6, 7, 8}));
  EXPECT_GT(alike, 2000);
}

TEST(ContactPatch, TiltedCubesKeepAFourPointFaceContact) {
  const Box cube(Vector::Constant(0.5));
  const ConvexHull hull = cube_hull(0.5);
  for (const char* name : {"gjk", "sat"}) {
    for (const Vector& axis : {Vector(1, 0, 0), Vector(0, 0, 1), Vector(1, 0, 1).normalized().eval(),
                               Vector(1, 0.2, -0.7).normalized().eval()}) {
      std::set<FeatureName> before;
      for (double tilt = 0; tilt <= 0.05001; tilt += 0.0005) {
        const Manifold m = phase(name).manifold(cube, {}, cube, at({0.1, 0.99, 0.05}, tilt * axis));
        ASSERT_EQ(m.count, 4u) << name << tilt << " about " << axis.transpose();
        EXPECT_LT(m.normal.y(), -0.99);
        EXPECT_GE(deepest(m), 0.0099);
        if (tilt > 0.0005) {
          EXPECT_EQ(names(m), before) << name << tilt << " about " << axis.transpose();
        }
        before = names(m);
        if (name == std::string("gjk")) {
          EXPECT_EQ(gjk().manifold(hull, {}, hull, at({0.1, 0.99, 0.05}, tilt * axis)).count, 4u) << tilt;
        }
      }
    }
  }
}

TEST(ContactPatch, AFaceTurnedBy45DegreesIsAnOctagon) {
  const Pose turned = at({0, 0, 1.999}, {0, 0, std::numbers::pi / 4});
  const Box box({1, 1, 1});
  const ConvexHull hull = cube_hull(1);
  for (const Manifold& m : {gjk().manifold(box, {}, box, turned), gjk().manifold(hull, {}, box, turned),
                            gjk().manifold(hull, {}, hull, turned)}) {
    ASSERT_EQ(m.count, 8u);
    EXPECT_EQ(names(m).size(), 8u);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_EQ(m.points[k].feature.kind, Kind::edge_edge);
      EXPECT_NEAR(m.points[k].depth, 0.001, 1e-12);
      EXPECT_NEAR(m.points[k].point.head<2>().norm(), std::hypot(1, std::numbers::sqrt2 - 1), 1e-12);
    }
  }
}

TEST(ContactPatch, ACylinderStandsOnItsRimAndLiesOnItsSide) {
  const HalfSpace floor(Vector(0, 0, 1));
  const Box table({5, 5, 1});
  const Cylinder cylinder(0.5, 2);
  for (const bool on_table : {false, true}) {
    const Shape& below = on_table ? static_cast<const Shape&>(table) : floor;
    const Pose under = on_table ? at({0, 0, -1}) : Pose{};
    const Manifold standing = gjk().manifold(cylinder, at({1, 2, 0.999}), below, under);
    ASSERT_EQ(standing.count, 8u);
    Vector middle = Vector::Zero();
    for (std::size_t k = 0; k < 8; ++k) {
      middle += standing.points[k].point / 8;
      EXPECT_NEAR((standing.points[k].point - Vector(1, 2, -0.0005)).norm(), 0.5, 1e-9);
      EXPECT_NEAR(standing.points[k].depth, 0.001, 1e-9);
    }
    EXPECT_NEAR((middle - Vector(1, 2, -0.0005)).norm(), 0, 1e-9);
    const Manifold lying = gjk().manifold(cylinder, at({1, 2, 0.499}, on_side), below, under);
    ASSERT_EQ(lying.count, 2u);
    EXPECT_TRUE(has(lying, {0, 2, -0.0005}, 1e-9));
    EXPECT_TRUE(has(lying, {2, 2, -0.0005}, 1e-9));
    // Tilted, its lowest point is one of them.
    const Manifold tilted = gjk().manifold(cylinder, at({1, 2, 1}, {0.02, 0.011, 0}), below, under);
    EXPECT_GE(tilted.count, 4u);
    const double expected = std::cos(std::hypot(0.02, 0.011)) + 0.5 * std::sin(std::hypot(0.02, 0.011)) - 1;
    EXPECT_NEAR(deepest(tilted), expected, 1e-9);
  }
}

TEST(ContactPatch, ACapsuleLiesOnABoxWithTwoPoints) {
  const Box table({5, 5, 1});
  const Capsule capsule(0.5, 2);
  const Manifold whole = gjk().manifold(table, {}, capsule, at({1, 0, 1.49}, on_side));
  ASSERT_EQ(whole.count, 2u);
  EXPECT_TRUE(has(whole, {0, 0, 0.995}, 1e-9));
  EXPECT_TRUE(has(whole, {2, 0, 0.995}, 1e-9));
  EXPECT_EQ(names(whole), (std::set<FeatureName>{{Kind::face_vertex, 5, 0}, {Kind::face_vertex, 5, 1}}));
  const Manifold beyond = gjk().manifold(table, {}, capsule, at({4.5, 0, 1.49}, on_side));
  ASSERT_EQ(beyond.count, 2u);
  EXPECT_TRUE(has(beyond, {3.5, 0, 0.995}, 1e-9));
  EXPECT_TRUE(has(beyond, {5, 0, 0.995}, 1e-9));
  EXPECT_NE(beyond.points[0].feature, beyond.points[1].feature);
  const Manifold rocking = gjk().manifold(table, {}, capsule, at({1, 0, 1.49}, {0, std::numbers::pi / 2 + 0.01, 0}));
  EXPECT_EQ(rocking.count, 2u);
  EXPECT_EQ(names(rocking), names(whole));
}

TEST(ContactPatch, EdgesSideBySideMeetInTwoPoints) {
  const Capsule capsule(0.5, 2);
  const Manifold m = gjk().manifold(capsule, at({0, 0, 0}, on_side), capsule, at({0.5, 0, 0.99}, on_side));
  ASSERT_EQ(m.count, 2u);
  EXPECT_TRUE(has(m, {1, 0, 0.495}, 1e-12));
  EXPECT_TRUE(has(m, {-0.5, 0, 0.495}, 1e-12));
  EXPECT_NE(m.points[0].feature, m.points[1].feature);
  const Manifold crossed =
      gjk().manifold(capsule, at({0, 0, 0}, on_side), capsule, at({0, 0, 0.99}, {std::numbers::pi / 2, 0, 0}));
  ASSERT_EQ(crossed.count, 1u);
  EXPECT_EQ(crossed.points[0].feature.kind, Kind::edge_edge);
}

TEST(ContactPatch, ManyCornersAreReducedAndTheExtremeOnesStay) {
  const ConvexHull wheel = prism(64, 1, 0.1);
  const HalfSpace floor(Vector(0, 0, 1));
  const Box table({5, 5, 1});
  for (const double tilt : {0.0, 1e-3, 0.03}) {
    const Pose pose = at({0, 0, 0.099}, {tilt, 0, 0});
    for (const Manifold& m :
         {gjk().manifold(wheel, pose, floor, {}), gjk().manifold(wheel, pose, table, at({0, 0, -1}))}) {
      ASSERT_EQ(m.count, 8u) << tilt;
      const Distance d = gjk().distance(wheel, pose, floor, {});
      EXPECT_NEAR(deepest(m), -d.distance, 1e-12) << tilt;
      Vector sum = Vector::Zero();
      for (std::size_t k = 0; k < 8; ++k) sum += m.points[k].point / 8;
      EXPECT_LE(sum.norm(), 0.1) << "they stand all round";
    }
  }
}

TEST(ContactPatch, NamesStayWhileAPairSlides) {
  const Box box({1, 1, 1});
  const ConvexHull wheel = prism(20, 0.5, 0.3);
  const Cylinder cylinder(0.5, 0.6);
  const Capsule capsule(0.3, 1);
  const std::pair<const Shape*, Pose> upper[] = {{&box, at({0.3, 0.4, 1.999}, {0, 0, 0.2})},
                                                 {&wheel, at({0.1, 0.1, 1.299}, {0, 0, 0.1})},
                                                 {&cylinder, at({0.1, 0.1, 1.299})},
                                                 {&capsule, at({0.1, 0.1, 1.299}, on_side)}};
  for (const auto& [shape, start] : upper) {
    std::set<FeatureName> before;
    for (int step = 0; step < 40; ++step) {
      Pose pose = start;
      pose.position += step * Vector(5e-4, 3e-4, 0);
      const Manifold m = gjk().manifold(box, {}, *shape, pose);
      ASSERT_EQ(names(m).size(), m.count) << shape->kind();
      if (step > 0) {
        ASSERT_EQ(names(m), before) << shape->kind() << ", step " << step;
      }
      before = names(m);
    }
  }
}

TEST(ContactPatch, CompoundsStandOnAllTheirParts) {
  const auto leg = [](double x, double y) {
    std::vector<Vector> points;
    for (int k = 0; k < 8; ++k)
      points.emplace_back(x + (k & 1 ? 0.1 : -0.1), y + (k & 2 ? 0.1 : -0.1), k & 4 ? 0.0 : -1.0);
    return std::make_shared<const ConvexHull>(points);
  };
  const Compound table({leg(1, 1), leg(-1, 1), leg(1, -1), leg(-1, -1)});
  const HalfSpace floor(Vector(0, 0, 1));
  const Box ground({5, 5, 1});
  for (const Manifold& m : {gjk().manifold(table, at({0, 0, 0.99}), floor, {}),
                            gjk().manifold(table, at({0, 0, 0.99}), ground, at({0, 0, -1}))}) {
    ASSERT_GE(m.count, 4u);
    for (const double x : {-1.1, 1.1}) {
      for (const double y : {-1.1, 1.1}) EXPECT_TRUE(has(m, {x, y, -0.005}));
    }
    std::set<std::uint32_t> parts;
    for (std::size_t k = 0; k < m.count; ++k) parts.insert(m.points[k].feature.of_a / 65536);
    EXPECT_EQ(parts.size(), 4u);
  }
}

}  // namespace
}  // namespace polhode::contact_patch_test
