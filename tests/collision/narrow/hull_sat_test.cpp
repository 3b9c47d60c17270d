// SPDX-License-Identifier: BSD-3-Clause
// `sat` on hulls, spheres, capsules, half-spaces and compounds: boxes as hulls against the exact judge of boxes, hulls
// against all axes that their features have and against gjk, closed forms, published cases by name.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/sphere.hpp"
#include "experiments/narrow_phase/box_pairs.hpp"
#include "tests/collision/narrow/exact_boxes.hpp"
#include "tests/collision/narrow/placed_pairs.hpp"

namespace polhode::hull_sat_test {
namespace {

using study::narrow_phase::BoxPairCase;
using study::narrow_phase::BoxPairs;
using Vector = Vector3<double>;

const NarrowPhase& sat_phase() {
  static const auto narrow = find_narrow_phase("sat")->make();
  return *narrow;
}
Distance distance(const PlacedPair& p) { return sat_phase().distance(*p.a, p.at_a, *p.b, p.at_b); }

ConvexHull corners(const Vector& half) {
  std::vector<Vector> points;
  for (int k = 0; k < 8; ++k)
    points.push_back(half.cwiseProduct(Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return ConvexHull(points);
}

/// Expects the properties of every answer: a unit normal, and witness points that it joins.
void expect_sound(const Distance& d, double scale) {
  EXPECT_NEAR(d.normal.norm(), 1, 1e-14);
  EXPECT_LT((d.on_a - d.on_b - d.distance * d.normal).norm(), 1e-9 * scale);
}

void expect_mirrored(const Distance& d, const Distance& m) {
  EXPECT_EQ(d.distance, m.distance);
  EXPECT_EQ(d.normal, -m.normal);
  EXPECT_EQ(d.on_a, m.on_b);
  EXPECT_EQ(d.on_b, m.on_a);
}

void judge_boxes_as_hulls(std::uint64_t seed, std::uint64_t count) {
  BoxPairs pairs(seed);
  for (std::uint64_t k = 0; k < count; ++k) {
    const BoxPairCase pair = pairs(k);
    const long double truth = exact_distance(pair.a, pair.b).distance;
    const ConvexHull a = corners(pair.a.half), b = corners(pair.b.half);
    const Box box(pair.b.half);
    const Pose at_a{pair.a.position, rotation_matrix<double>(pair.a.orientation)};
    const Pose at_b{pair.b.position, rotation_matrix<double>(pair.b.orientation)};
    const double smaller = std::min(pair.a.half.minCoeff(), pair.b.half.minCoeff());
    const double larger = std::max(pair.a.half.maxCoeff(), pair.b.half.maxCoeff());
    for (const Shape* other : {static_cast<const Shape*>(&b), static_cast<const Shape*>(&box)}) {
      const Distance d = sat_phase().distance(a, at_a, *other, at_b);
      ASSERT_NEAR(double(d.distance - truth), 0, 1e-9 * smaller) << pair.what << k;
      // The direction of a short difference is as sure as round-off over its length.
      const double slack = 1e-9 * smaller + (d.distance > 0 ? 4e-16 * larger * larger / d.distance : 0);
      ASSERT_NEAR(d.normal.norm(), 1, 1e-14) << pair.what << k;
      ASSERT_LE((d.on_a - d.on_b - d.distance * d.normal).norm(), slack) << pair.what << k;
      if (std::abs(truth) > 1e-14L * larger) {
        ASSERT_EQ(sat_phase().overlap(a, at_a, *other, at_b), truth < 0) << pair.what << k;
      }
      // Moving B by the depth separates; apart, the normal is one along which they are as far apart.
      ExactBox moved = pair.b;
      moved.position += d.distance * d.normal;
      if (d.distance < 0) {
        ASSERT_GE(double(exact_distance(pair.a, moved).distance), -1e-9 * smaller) << pair.what << k;
      } else {
        const auto reach = [&](const Vector& half, const Pose& at) {
          return (at.rotation.transpose() * d.normal).cwiseAbs().dot(half);
        };
        const double gap =
            -d.normal.dot(at_b.position - at_a.position) - reach(pair.a.half, at_a) - reach(pair.b.half, at_b);
        ASSERT_NEAR(gap, d.distance, slack) << pair.what << k;
      }
      expect_mirrored(d, sat_phase().distance(*other, at_b, a, at_a));
      if (testing::Test::HasFailure()) FAIL() << pair.what << k;
    }
  }
}

TEST(HullSat, BoxesAsHullsAgainstTheExactJudge) { judge_boxes_as_hulls(21, 800); }
TEST(HullSat, ManyBoxesAsHullsAgainstTheExactJudgeSlow) { judge_boxes_as_hulls(22, 50000); }

TEST(HullSat, HullsAgreeWithAllTheirAxes) {
  for (std::uint64_t k = 0; k < 60; ++k) {
    const PlacedPair p = hull_pair(k);
    const auto truth = double(separation_of_hulls(p));  // the signed distance where they overlap, else a lower bound
    const Distance d = distance(p);
    const double small = std::min(p.size_a, p.size_b);
    if (truth <= 0) {
      ASSERT_NEAR(d.distance, truth, 1e-11 * small) << k;
    } else {
      ASSERT_GE(d.distance, truth - 1e-11 * small) << k;
    }
    expect_sound(d, small);
  }
}

TEST(HullSat, AgreesWithGjk) {
  const auto gjk = find_narrow_phase("gjk")->make();
  int count = 0;
  for (std::uint64_t k = 0; count < 1500; ++k) {
    const PlacedPair p = k % 3 == 0 ? hull_pair(k) : any_pair(k);
    if (!p.polytopes) continue;
    ++count;
    const Distance d = distance(p);
    const double small = std::min(p.size_a, p.size_b);
    ASSERT_NEAR(d.distance, gjk->distance(*p.a, p.at_a, *p.b, p.at_b).distance, 1e-9 * small) << k;
    expect_sound(d, small);
  }
}

// Drake, geometry/proximity: a capsule of radius 2 and segment 4 along z against a box 1 × 2 × 4 at the origin.
TEST(HullSat, DrakeCapsuleAgainstBox) {
  const Capsule capsule(2, 4);
  const Box box({0.5, 1, 2});
  const auto turned = [](const Vector& position, const Vector& rotation_vector) {
    return Pose{position, rotation_matrix(quaternion_from_rotation_vector<double>(rotation_vector))};
  };
  EXPECT_NEAR(sat_phase().distance(capsule, turned({3, 0, 0}, Vector::Zero()), box, {}).distance, 0.5, 1e-14);
  EXPECT_NEAR(sat_phase().distance(capsule, turned({0, 0, 8}, Vector::Zero()), box, {}).distance, 2.0, 1e-14);
  EXPECT_NEAR(sat_phase().distance(capsule, turned({-10, 0.8, 1.5}, {0, std::numbers::pi / 2, 0}), box, {}).distance,
              5.5, 1e-14);
}

TEST(HullSat, RoundShapesInClosedForm) {
  const Sphere small(0.5), large(2);
  const Capsule capsule(0.25, 3);
  for (const double x : {0.0, 1e-300, 1e-12, 1.0, 2.4999999, 2.5, 2.5000001, 100.0}) {
    const Distance d = sat_phase().distance(small, {{x, 0, 0}}, large, {});
    EXPECT_NEAR(d.distance, x - 2.5, 1e-15 * (1 + x)) << x;
    expect_sound(d, 1e-6);
    if (x > 0) {
      EXPECT_NEAR(d.normal[0], 1, 1e-14) << x;
    }
    EXPECT_NEAR(sat_phase().distance(small, {{x, 0, 1}}, capsule, {}).distance, x - 0.75, 1e-15 * (1 + x)) << x;
  }
  // Crossing, parallel, in line and the same: the segments meet, and the depth is that of the radii.
  const auto crossed = [](double x, double angle) {
    return Pose{{0, 0, x}, rotation_matrix<double>(Quaternion<double>(std::cos(angle), std::sin(angle), 0, 0))};
  };
  for (const Pose& at : {crossed(0.3, 0.55), crossed(2, 0), Pose{}}) {
    const Distance d = sat_phase().distance(capsule, {}, capsule, at);
    EXPECT_NEAR(d.distance, -0.5, 1e-15);
    expect_sound(d, 1e-6);
    Pose moved = at;
    moved.position += d.distance * d.normal;
    EXPECT_NEAR(sat_phase().distance(capsule, {}, capsule, moved).distance, 0, 1e-15);
  }
  EXPECT_NEAR(sat_phase().distance(capsule, {}, capsule, {{0.4, 0, 1}}).distance, -0.1, 1e-15);
  EXPECT_NEAR(sat_phase().distance(capsule, {}, capsule, {{0, 0, 3.25}}).distance, -0.25, 1e-15);
  // A ball's centre within a box, and on its face; a segment through a box.
  const Box box({1, 2, 3});
  EXPECT_NEAR(sat_phase().distance(small, {{0.75, 0, 0}}, box, {}).distance, -0.75, 1e-15);
  EXPECT_NEAR(sat_phase().distance(small, {{1, 0.5, 0.5}}, box, {}).distance, -0.5, 1e-15);
  EXPECT_NEAR(sat_phase().distance(small, {}, box, {}).distance, -1.5, 1e-15);
  EXPECT_NEAR(sat_phase().distance(small, {{4, 6, 0}}, box, {}).distance, 4.5, 1e-15);
  EXPECT_NEAR(sat_phase().distance(capsule, {{0.5, 0, 0}}, box, {}).distance, -0.75, 1e-15);
}

// A segment across an edge of a cube: its depth is along the product of the two, at 45 degrees to the faces.
TEST(HullSat, SegmentAcrossAnEdge) {
  const Box cube({1, 1, 1});
  const double root = std::numbers::sqrt2;
  const Capsule rod(0.125, 8);
  // Along (1, −1, 0), turned about z from the edge at x = y = 1.
  const Pose at{{0.875, 0.875, 0},
                rotation_matrix<double>(
                    quaternion_from_rotation_vector<double>(Vector(1, 1, 0).normalized() * (std::numbers::pi / 2)))};
  const Distance d = sat_phase().distance(rod, at, cube, {});
  EXPECT_NEAR(d.distance, -(0.125 * root + 0.125), 1e-15);
  EXPECT_NEAR((d.normal - Vector(1, 1, 0) / root).norm(), 0, 1e-15);
}

TEST(HullSat, HalfSpacesAndCompounds) {
  const HalfSpace floor({0, 0, 2}, 1);
  const Box box({1, 1, 1});
  const Pose on_edge{{5, 6, 2},
                     rotation_matrix<double>(quaternion_from_rotation_vector<double>({std::numbers::pi / 4, 0, 0}))};
  const Distance d = sat_phase().distance(box, on_edge, floor, {});
  EXPECT_NEAR(d.distance, 1.5 - std::numbers::sqrt2, 1e-15);
  EXPECT_EQ(d.normal, Vector(0, 0, 1));
  expect_sound(d, 1e-6);
  expect_mirrored(d, sat_phase().distance(floor, {}, box, on_edge));
  EXPECT_NEAR(sat_phase().distance(floor, {}, Sphere(0.25), {{1, 2, 0}}).distance, -0.75, 1e-15);

  std::vector<Compound::Part> parts;
  const ConvexHull cube = corners({0.5, 0.5, 0.5});
  for (const double x : {-2.0, 2.0}) {
    std::vector<Vector> points;
    for (const Vector& v : cube.polytope().vertices) points.push_back(v + Vector(x, 0, 0));
    parts.push_back(std::make_shared<ConvexHull>(points));
  }
  const Compound pair(parts);
  EXPECT_NEAR(sat_phase().distance(pair, {}, Sphere(0.5), {}).distance, 1, 1e-15);
  EXPECT_NEAR(sat_phase().distance(Sphere(0.5), {{2, 0.75, 0}}, pair, {}).distance, -0.25, 1e-15);
  EXPECT_NEAR(sat_phase().distance(pair, {}, pair, {{4.75, 0, 0}}).distance, -0.25, 1e-15);
  EXPECT_NEAR(sat_phase().distance(pair, {{0, 0, 3}}, floor, {}).distance, 2, 1e-15);
}

RC_GTEST_PROP(HullSat, MirrorsExactlyAndARigidMotionChangesRoundOffOnly, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const PlacedPair p = seed % 4 == 0 ? hull_pair(seed) : any_pair(seed);
  RC_PRE(p.polytopes);
  const Distance d = distance(p), m = sat_phase().distance(*p.b, p.at_b, *p.a, p.at_a);
  RC_ASSERT(d.distance == m.distance);
  RC_ASSERT(d.normal == -m.normal);
  RC_ASSERT(d.on_a == m.on_b);
  RC_ASSERT(d.on_b == m.on_a);
  const double size = p.size_a + p.size_b;
  const Pose motion = random_pose(seed + 1, size);
  PlacedPair q = p;
  for (Pose* at : {&q.at_a, &q.at_b}) *at = {motion.to_world(at->position), motion.rotation * at->rotation};
  RC_ASSERT(std::abs(d.distance - distance(q).distance) <=
            1e-14 * (size + p.at_a.position.norm() + p.at_b.position.norm()));
}

TEST(HullSat, SaysWhatItCannotDo) {
  const Box box({1, 1, 1});
  const Sphere ball(1);
  try {
    (void)sat_phase().distance(Cylinder(1, 2), {}, box, {});
    ADD_FAILURE();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("take gjk"), std::string::npos) << e.what();
  }
  Pose bad;
  bad.position[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)sat_phase().distance(ball, {}, box, bad), std::invalid_argument);
  EXPECT_THROW((void)sat_phase().distance(ball, bad, HalfSpace({0, 0, 1}), {}), std::invalid_argument);
  bad.position[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)sat_phase().overlap(ball, bad, ball, {}), std::invalid_argument);
}

}  // namespace
}  // namespace polhode::hull_sat_test
