// SPDX-License-Identifier: BSD-3-Clause
// gjk: boxes against the exact judge, round shapes against closed forms, and published cases by name. Hulls are in
// hull_judge_test.cpp, what holds for every pair in laws/narrow_phase_law_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/ellipsoid.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/sphere.hpp"
#include "core/math/portable_random.hpp"
#include "tests/collision/narrow/box_judge.hpp"
#include "tests/collision/narrow/placed_pairs.hpp"

namespace polhode::gjk_test {
namespace {

using Vector = Vector3<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

const NarrowPhase& gjk_phase() {
  static const auto narrow = find_narrow_phase("gjk")->make();
  return *narrow;
}

/// Expects the properties of every answer: a unit normal, witness points that it joins, no NaN.
void expect_sound(const Distance& d, double scale) {
  EXPECT_NEAR(d.normal.norm(), 1, 1e-14);
  EXPECT_LT((d.on_a - d.on_b - d.distance * d.normal).norm(), 1e-9 * scale);
}

Pose turned(const Vector& position, const Vector& rotation_vector) {
  return {position, rotation_matrix(quaternion_from_rotation_vector<double>(rotation_vector))};
}

TEST(Gjk, IsRightOnRandomAndDegenerateBoxes) { judge_many(gjk_phase(), 1, 2000, 1e-8); }
TEST(Gjk, IsRightOnManyRandomAndDegenerateBoxesSlow) { judge_many(gjk_phase(), 2, 100000, 1e-8); }

TEST(Gjk, PublishedBoxCases) { judge_published(gjk_phase(), 1e-8); }

// Drake, geometry/proximity: a capsule of radius 2 and segment 4 along z against a box 1 × 2 × 4 at the origin.
TEST(Gjk, DrakeCapsuleAgainstBox) {
  const Capsule capsule(2, 4);
  const Box box({0.5, 1, 2});
  EXPECT_NEAR(gjk_phase().distance(capsule, turned({3, 0, 0}, Vector::Zero()), box, {}).distance, 0.5, 1e-14);
  EXPECT_NEAR(gjk_phase().distance(capsule, turned({0, 0, 8}, Vector::Zero()), box, {}).distance, 2.0, 1e-14);
  EXPECT_NEAR(gjk_phase().distance(capsule, turned({-10, 0.8, 1.5}, {0, std::numbers::pi / 2, 0}), box, {}).distance,
              5.5, 1e-14);
}

// Depth of spheres and capsules by their cores, also where these meet.
TEST(Gjk, RoundShapesInClosedForm) {
  const Sphere small(0.5), large(2);
  const Capsule capsule(0.25, 3);
  for (const double x : {0.0, 1e-300, 1e-12, 1.0, 2.4999999, 2.5, 2.5000001, 100.0}) {
    const Distance d = gjk_phase().distance(small, {{x, 0, 0}}, large, {});
    EXPECT_NEAR(d.distance, x - 2.5, 1e-15 * (1 + x)) << x;
    expect_sound(d, 1e-6);
    if (x > 1e-200) {
      EXPECT_NEAR(d.normal[0], 1, 1e-14);
    }
    EXPECT_EQ(gjk_phase().overlap(small, {{x, 0, 0}}, large, {}), d.distance <= 0) << x;
    const double on_axis = gjk_phase().distance(small, {{x, 0, 1}}, capsule, {}).distance;
    EXPECT_NEAR(on_axis, x - 0.75, 1e-15 * (1 + x)) << x;
  }
  // Crossing, parallel, in line and the same: the segments meet, and the depth is that of the radii.
  EXPECT_NEAR(gjk_phase().distance(capsule, {}, capsule, turned({0, 0, 0.3}, {1.1, 0, 0})).distance, -0.5, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(capsule, {}, capsule, {{0.4, 0, 1}}).distance, -0.1, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(capsule, {}, capsule, {{0, 0, 3.25}}).distance, -0.25, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(capsule, {}, capsule, {{0, 0, 2}}).distance, -0.5, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(capsule, {}, capsule, {}).distance, -0.5, 1e-15);
  // A ball's centre within a box, and on its face.
  const Box box({1, 2, 3});
  EXPECT_NEAR(gjk_phase().distance(small, {{0.75, 0, 0}}, box, {}).distance, -0.75, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(small, {{1, 0.5, 0.5}}, box, {}).distance, -0.5, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(small, {}, box, {}).distance, -1.5, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(small, {{4, 6, 0}}, box, {}).distance, 4.5, 1e-15);
}

TEST(Gjk, CylindersAndEllipsoidsInClosedForm) {
  const Cylinder cylinder(0.5, 2);
  const Ellipsoid ellipsoid({1, 2, 3});
  const Sphere sphere(0.25);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, sphere, {{2, 0, 0.3}}).distance, 1.25, 1e-12);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, sphere, {{0.2, 0.1, 2}}).distance, 0.75, 1e-12);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, sphere, {{3.5, 4, 2}}).distance,
              std::hypot(std::hypot(3.5, 4.0) - 0.5, 1) - 0.25, 1e-9);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, sphere, {{0.3, 0, 0}}).distance, -0.45, 1e-9);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, cylinder, {{0.1, 0, 1.9}}).distance, -0.1, 1e-12);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, cylinder, {{0.8, 0, 0}}).distance, -0.2, 1e-9);
  EXPECT_NEAR(gjk_phase().distance(cylinder, {}, cylinder, {}).distance, -1, 1e-9);
  EXPECT_NEAR(gjk_phase().distance(ellipsoid, {}, sphere, {{0, 0, 5}}).distance, 1.75, 1e-9);
  EXPECT_NEAR(
      gjk_phase().distance(ellipsoid, {}, ellipsoid, turned({3.5, 0, 0}, {0, 0, std::numbers::pi / 2})).distance, 0.5,
      1e-9);
  EXPECT_NEAR(gjk_phase().distance(ellipsoid, {}, ellipsoid, {{1.5, 0, 0}}).distance, -0.5, 1e-9);
  EXPECT_NEAR(gjk_phase().distance(ellipsoid, {}, ellipsoid, {}).distance, -2, 1e-9);
}

// The box's lowest corner above the floor, and every other finite shape by its support.
TEST(Gjk, HalfSpaceAgainstAll) {
  const HalfSpace floor({0, 0, 2}, 1), ceiling({0, 0, -1}, -3);
  const Box box({1, 1, 1});
  const Distance d = gjk_phase().distance(box, turned({5, 6, 2}, {std::numbers::pi / 4, 0, 0}), floor, {});
  EXPECT_NEAR(d.distance, 1.5 - std::numbers::sqrt2, 1e-15);
  EXPECT_EQ(d.normal, Vector(0, 0, 1));
  expect_sound(d, 1e-6);
  EXPECT_NEAR(gjk_phase().distance(floor, {}, Sphere(0.25), {{1, 2, 0}}).distance, -0.75, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(floor, {}, ceiling, {}).distance, 2.5, 1e-15);
  EXPECT_EQ(gjk_phase().distance(floor, {}, HalfSpace({1, 0, 0}), {}).distance, -infinity);
  EXPECT_TRUE(gjk_phase().overlap(floor, {}, HalfSpace({1, 0, 0}), {}));
}

// Touching is contact: coincident, nested and kissing shapes of every kind always have an answer.
TEST(Gjk, NeverDropsATouchingContact) {
  PortableRandom random(1);
  for (const double size : {0.01, 0.5, 1000.0}) {
    const Box box(Vector::Constant(size / 2));
    for (int k = 0; k < 200; ++k) {
      const Pose at{5 * size * random.direction(), random.rotation()};
      for (int axis = 0; axis < 3; ++axis) {
        const Pose beside = {at.position + size * at.rotation.col(axis), at.rotation};
        const Distance d = gjk_phase().distance(box, at, box, beside);
        EXPECT_NEAR(d.distance, 0, 1e-15 * (size + 4 * at.position.norm()));
        EXPECT_NEAR(std::abs(d.normal.dot(at.rotation.col(axis))), 1, 1e-12);
        const Pose deeper = {at.position + (1 - 1e-13) * size * at.rotation.col(axis), at.rotation};
        EXPECT_TRUE(gjk_phase().overlap(box, at, box, deeper));
        EXPECT_EQ(gjk_phase().manifold(box, at, box, deeper).count, 4u);
      }
      EXPECT_NEAR(gjk_phase().distance(box, at, box, at).distance, -size, 4e-15 * size);
    }
  }
}

// Deep pairs that move a little, and now and then further: the polytope that is remembered loses its convexity, and its
// origin.
TEST(Gjk, WarmDepthIsColdDepth) {
  const Box box({0.7, 0.5, 0.9}), other({0.4, 1.1, 0.6});
  const ShapePointer hull = hull_pair(3).a;
  const double size = hull_pair(3).size_a;
  int together = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    PairMemory memory;
    const Shape& a = k % 2 ? static_cast<const Shape&>(box) : *hull;
    const double unit = k % 2 ? 1 : size;
    const Pose at_a = random_pose(k, unit);
    Pose at_b = {at_a.position + 0.3 * random_pose(k + 1, unit).position, random_pose(k + 2, 1).rotation};
    for (std::uint64_t step = 0; step < 30; ++step) {
      const double far = step % 7 == 3 ? 0.1 : 0.01;
      at_b.position += far * random_pose(1000 * k + step, unit).position;
      at_b.rotation = turned(Vector::Zero(), far * random_pose(step, 1).position).rotation * at_b.rotation;
      const Distance warm =
          gjk_phase().distance(a, at_a, k % 2 ? static_cast<const Shape&>(other) : *hull, at_b, &memory);
      const Distance cold = gjk_phase().distance(a, at_a, k % 2 ? static_cast<const Shape&>(other) : *hull, at_b);
      ASSERT_NEAR(warm.distance, cold.distance, 1e-13 * unit) << k << ", step " << step;
      together += cold.distance < 0;
    }
  }
  EXPECT_GT(together, 3000);
}

}  // namespace
}  // namespace polhode::gjk_test
