// SPDX-License-Identifier: BSD-3-Clause
// gjk on compounds: an L of two boxes against one shape and against another L, by hand and by its parts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/sphere.hpp"
#include "tests/collision/narrow/placed_pairs.hpp"

namespace polhode::gjk_compound_test {
namespace {

using Vector = Vector3<double>;

const NarrowPhase& gjk_phase() {
  static const auto narrow = find_narrow_phase("gjk")->make();
  return *narrow;
}

Compound::Part brick(const Vector& low, const Vector& high) {
  std::vector<Vector> points;
  for (unsigned k = 0; k < 8; ++k) {
    points.push_back({k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]});
  }
  return std::make_shared<ConvexHull>(points);
}

/// [0, 3] × [0, 1]² and [0, 1] × [1, 3] × [0, 1].
const Compound& ell() {
  static const Compound l({brick({0, 0, 0}, {3, 1, 1}), brick({0, 1, 0}, {1, 3, 1})});
  return l;
}

TEST(GjkCompound, KnowsItsNotch) {
  // The ball lies in the notch, which the convex hull of the L would fill.
  const Sphere ball(0.25);
  const Distance d = gjk_phase().distance(ball, {{1.5, 2.5, 0.5}}, ell(), {});
  EXPECT_NEAR(d.distance, 0.25, 1e-15);
  EXPECT_NEAR(d.normal[0], 1, 1e-15);
  EXPECT_FALSE(gjk_phase().overlap(ball, {{1.5, 2.5, 0.5}}, ell(), {}));
  EXPECT_EQ(gjk_phase().manifold(ball, {{1.5, 2.5, 0.5}}, ell(), {}).count, 0u);
  // The nearer of the two, touching, and the deeper of two that overlap.
  EXPECT_NEAR(gjk_phase().distance(ball, {{2, 2, 0.5}}, ell(), {}).distance, 0.75, 1e-15);
  EXPECT_NEAR(gjk_phase().distance(ball, {{1.25, 2, 0.5}}, ell(), {}).distance, 0, 1e-15);
  EXPECT_TRUE(gjk_phase().overlap(ball, {{1.25 - 1e-12, 2, 0.5}}, ell(), {}));
  const Distance deep = gjk_phase().distance(Sphere(0.5), {{1.25, 1.375, 0.5}}, ell(), {});
  EXPECT_NEAR(deep.distance, -0.25, 1e-15);
  EXPECT_NEAR(deep.normal[0], 1, 1e-12);
  EXPECT_EQ(gjk_phase().manifold(Sphere(0.5), {{1.25, 1.375, 0.5}}, ell(), {}).count, 1u);
}

TEST(GjkCompound, AnotherCompoundHooksIntoIt) {
  // Turned by half a turn about z, the other L sits in the notch with gaps of 0.25 and 0.5, and its notch over this
  // one.
  const Pose hooked = {{2.25, 4.5, 0},
                       rotation_matrix(quaternion_from_rotation_vector<double>({0, 0, std::numbers::pi}))};
  EXPECT_NEAR(gjk_phase().distance(ell(), {}, ell(), hooked).distance, 0.25, 1e-14);
  EXPECT_FALSE(gjk_phase().overlap(ell(), {}, ell(), hooked));
  const Pose closer = {{1.875, 4.5, 0}, hooked.rotation};
  const Distance d = gjk_phase().distance(ell(), {}, ell(), closer);
  EXPECT_NEAR(d.distance, -0.125, 1e-14);
  EXPECT_NEAR(std::abs(d.normal[0]), 1, 1e-12);
  EXPECT_TRUE(gjk_phase().overlap(ell(), {}, ell(), closer));
}

TEST(GjkCompound, StandsOnAFloor) {
  const HalfSpace floor({0, 0, 1});
  for (const double lift : {0.5, 0.0, -0.25}) {
    EXPECT_NEAR(gjk_phase().distance(ell(), {{0, 0, lift}}, floor, {}).distance, lift, 1e-15);
    EXPECT_EQ(gjk_phase().overlap(floor, {}, ell(), {{0, 0, lift}}), lift <= 0);
  }
}

// The least of its parts' distances, with and without memory, mirrored, and the normal parts the deepest part.
TEST(GjkCompound, AnswersWithItsParts) {
  const Box box({0.5, 0.25, 1});
  const Cylinder cylinder(0.5, 1);
  const std::array<const Shape*, 3> others = {&box, &cylinder, &ell()};
  PairMemory memory;
  for (std::uint64_t k = 0; k < 300; ++k) {
    const Shape& other = *others[k % others.size()];
    const Pose at = random_pose(2 * k, 1), at_other = random_pose(2 * k + 1, 2);
    const Distance d = gjk_phase().distance(ell(), at, other, at_other);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& part : ell().parts())
      least = std::min(least, gjk_phase().distance(*part, at, other, at_other).distance);
    EXPECT_NEAR(d.distance, least, 1e-14) << k;
    const Distance mirrored = gjk_phase().distance(other, at_other, ell(), at);
    EXPECT_EQ(mirrored.distance, d.distance) << k;
    EXPECT_EQ(mirrored.normal, -d.normal) << k;
    EXPECT_EQ(mirrored.on_a, d.on_b) << k;
    EXPECT_EQ(gjk_phase().distance(ell(), at, other, at_other, &memory).distance, d.distance) << k;
    EXPECT_EQ(gjk_phase().overlap(ell(), at, other, at_other, &memory), d.distance <= 0) << k;
    EXPECT_LT((d.on_a - d.on_b - d.distance * d.normal).norm(), 1e-6) << k;
  }
}

}  // namespace
}  // namespace polhode::gjk_compound_test
