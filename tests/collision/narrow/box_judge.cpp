// SPDX-License-Identifier: BSD-3-Clause
#include "tests/collision/narrow/box_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

#include "collision/shapes/box.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "tests/collision/narrow/exact_boxes.hpp"

namespace polhode {
namespace {

Pose pose_of(const ExactBox& box) { return box.posed().pose; }

/// The gap between the shadows of the boxes on n, in long double.
long double shadow_gap(const ExactBox& a, const ExactBox& b, const Vector3<double>& n) {
  using Long = long double;
  const auto reach = [&](const ExactBox& box) {
    const Matrix3<Long> r = rotation_matrix<Long>(box.orientation.cast<Long>());
    return (r.transpose() * n.cast<Long>()).cwiseAbs().dot(box.half.cast<Long>());
  };
  return n.cast<Long>().dot(b.position.cast<Long>() - a.position.cast<Long>()) - reach(a) - reach(b);
}

/// The distance of a point outside a box, m.
double outside(const Vector3<double>& half, const Pose& pose, const Vector3<double>& x) {
  return (pose.to_body(x).cwiseAbs() - half).cwiseMax(0).norm();
}

}  // namespace

std::string describe(const BoxPairCase& pair) {
  std::ostringstream text;
  text.precision(17);
  text << pair.what;
  for (const ExactBox* box : {&pair.a, &pair.b}) {
    text << " | " << box->half.transpose() << " at " << box->position.transpose() << " q "
         << box->orientation.transpose();
  }
  return text.str();
}

void judge(const NarrowPhase& narrow, const BoxPairCase& pair, double share, double rounding) {
  const ExactDistance exact = exact_distance(pair.a, pair.b);
  const Box a(pair.a.half), b(pair.b.half);
  const Pose at_a = pose_of(pair.a), at_b = pose_of(pair.b);
  const Distance d = narrow.distance(a, at_a, b, at_b);
  const double larger = std::max(pair.a.half.maxCoeff(), pair.b.half.maxCoeff());
  const double smaller = std::min(pair.a.half.minCoeff(), pair.b.half.minCoeff());
  const double round_off = rounding * 1e-16 * (at_a.position.norm() + at_b.position.norm() + larger);
  const double tolerance = share * smaller + round_off, separated = 1e-9 * smaller + round_off;
  SCOPED_TRACE(describe(pair));
  ASSERT_NEAR(double(d.distance - exact.distance), 0, tolerance) << "exact: " << double(exact.distance);
  const bool overlap = narrow.overlap(a, at_a, b, at_b);
  if (std::abs(exact.distance) > 1e-14L * larger) {
    ASSERT_EQ(overlap, exact.sign < 0);
  }
  ASSERT_EQ(overlap, d.distance <= 0);
  ASSERT_NEAR(d.normal.norm(), 1, 1e-14);
  // Moving B by the depth separates; apart, the shadows on the normal are as far apart as the boxes. The direction of a
  // short difference is as sure as round-off over its length.
  const double unsure =
      exact.sign < 0 ? separated : tolerance + (d.distance > 0 ? 4e-16 * larger * larger / d.distance : 0);
  ASSERT_GE(double(shadow_gap(pair.a, pair.b, -d.normal) - exact.distance), -unsure);
  ASSERT_LE(outside(pair.a.half, at_a, d.on_a), tolerance);
  ASSERT_LE(outside(pair.b.half, at_b, d.on_b), tolerance);
  ASSERT_LE((d.on_a - d.on_b - d.distance * d.normal).norm(), tolerance);
  if (pair.a.half == pair.b.half && at_a.position == at_b.position && at_a.rotation == at_b.rotation) return;
  const Distance mirrored = narrow.distance(b, at_b, a, at_a);
  ASSERT_EQ(mirrored.distance, d.distance);
  ASSERT_EQ(mirrored.normal, -d.normal);
  ASSERT_EQ(mirrored.on_a, d.on_b);
  ASSERT_EQ(mirrored.on_b, d.on_a);
  ASSERT_EQ(narrow.overlap(b, at_b, a, at_a), overlap);
}

void judge_many(const NarrowPhase& narrow, std::uint64_t seed, std::uint64_t count, double share, double rounding) {
  BoxPairs pairs(seed);
  for (std::uint64_t k = 0; k < count; ++k) {
    judge(narrow, pairs(k), share, rounding);
    if (testing::Test::HasFatalFailure()) return;
  }
}

ConvexHull hull_of(const ExactBox& box) {
  std::vector<Vector3<double>> corners;
  for (int k = 0; k < 8; ++k) {
    corners.push_back(box.half.cwiseProduct(Vector3<double>(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  }
  return ConvexHull(corners);
}

void judge_published(const NarrowPhase& narrow, double share) {
  std::ifstream file(std::string(POLHODE_TESTS_DIR) + "/collision/narrow/collision_cases.csv");
  int count = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.starts_with("id,")) continue;
    std::istringstream cells(line);
    std::string id, name, cell;
    std::getline(cells, id, ',');
    std::getline(cells, name, ',');
    double x[22];
    for (double& number : x) {
      std::getline(cells, cell, ',');
      number = cell == "nan" ? std::numeric_limits<double>::quiet_NaN() : std::stod(cell);
    }
    const BoxPairCase pair{name,
                           {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8], x[9]}},
                           {{x[10], x[11], x[12]}, {x[13], x[14], x[15]}, {x[16], x[17], x[18], x[19]}}};
    judge(narrow, pair, share);
    // The same boxes as hulls of their corners.
    const ConvexHull hull_a = hull_of(pair.a), hull_b = hull_of(pair.b);
    const double truth = double(exact_distance(pair.a, pair.b).distance);
    const double smaller = std::min(pair.a.half.minCoeff(), pair.b.half.minCoeff());
    EXPECT_NEAR(narrow.distance(hull_a, pose_of(pair.a), hull_b, pose_of(pair.b)).distance, truth, share * smaller)
        << name;
    if (!std::isnan(x[20])) {
      const Box a(pair.a.half), b(pair.b.half);
      EXPECT_NEAR(narrow.distance(a, pose_of(pair.a), b, pose_of(pair.b)).distance, x[20], x[21]) << name;
      EXPECT_NEAR(double(exact_distance(pair.a, pair.b).distance), x[20], x[21]) << name;
    }
    ++count;
  }
  EXPECT_EQ(count, 42);
}

}  // namespace polhode
