// SPDX-License-Identifier: BSD-3-Clause
// The judge of hulls itself: what is known, boxes beside the judge of boxes, hulls beside all directions of their
// features.
#include "tests/collision/narrow/exact_hulls.hpp"

#include <gtest/gtest.h>

#include "experiments/narrow_phase/box_pairs.hpp"
#include "tests/collision/narrow/hull_pairs.hpp"
#include "tests/collision/narrow/placed_pairs.hpp"

namespace polhode::exact_hulls_test {
namespace {

using study::narrow_phase::BoxPairCase;
using study::narrow_phase::BoxPairs;
using Vector = Vector3<double>;

ExactHull box(const Vector& half, const Pose& pose = {}) {
  ExactHull hull{{}, pose};
  for (int k = 0; k < 8; ++k)
    hull.points.push_back(half.cwiseProduct(Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
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
  EXPECT_EQ(exact_distance(ExactHull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}},
                           ExactHull{tetrahedron.points, {{1, 1, 1}}})
                .distance,
            2 / std::sqrt(3.0L));
}

TEST(ExactHulls, FlatOnesAreRefused) {
  const ExactHull flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}};
  EXPECT_THROW((void)exact_distance(flat, flat), std::invalid_argument);
}

// The rotation of a quaternion is rounded before it reaches this judge.
TEST(ExactHulls, SayOfBoxesWhatTheJudgeOfBoxesSays) {
  BoxPairs make(6);
  for (std::uint64_t k = 0; k < 800; ++k) {
    const BoxPairCase pair = make(k);
    const auto posed = [](const ExactBox& b) {
      return box(b.half, {b.position, rotation_matrix<double>(b.orientation)});
    };
    const ExactDistance d = exact_distance(posed(pair.a), posed(pair.b)), expected = exact_distance(pair.a, pair.b);
    const long double rounding = 4e-16L * (pair.a.half.norm() + pair.b.half.norm());
    ASSERT_LE(std::abs(d.distance - expected.distance), rounding) << k << " " << pair.what;
    if (std::abs(expected.distance) > rounding) {
      ASSERT_EQ(d.sign, expected.sign) << k << " " << pair.what;
    }
  }
}

TEST(ExactHulls, SayWhatAllDirectionsOfTheirFeaturesSay) {
  for (std::uint64_t k = 0; k < 240; ++k) {
    const HullPairCase pair = hull_pair_case(4, k);
    if (pair.a->polytope().edges.size() * pair.b->polytope().edges.size() > 5000) continue;
    const ExactDistance d = exact_distance(ExactHull{pair.points_a, pair.at_a}, ExactHull{pair.points_b, pair.at_b});
    const long double separation = separation_of_hulls({pair.a, pair.b, pair.at_a, pair.at_b});
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
    ASSERT_NEAR(double(d.distance), double(mirrored.distance), 1e-17 * std::abs(double(d.distance)))
        << k << " " << pair.what;
    (d.sign > 0 ? apart : d.sign < 0 ? overlapping : touching) += 1;
  }
  EXPECT_GT(apart, 100u);
  EXPECT_GT(overlapping, 100u);
  EXPECT_GE(touching, 4u);
}

}  // namespace
}  // namespace polhode::exact_hulls_test
