// SPDX-License-Identifier: BSD-3-Clause
// `sat` on boxes against the exact judge, on random and degenerate pairs and on published cases; its symmetry; lanes.
#include "collision/narrow/box_sat.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "experiments/narrow_phase/box_pairs.hpp"
#include "tests/collision/exact_boxes.hpp"

namespace polhode {
namespace {

using Vector = Vector3<double>;

BoxAt at(const PosedBox& box) { return {box.half, box.pose}; }

/// How far apart the shadows of the boxes on n are when B lies `shift` further along n, in long double.
long double shadow_gap(const ExactBox& a, const ExactBox& b, const Vector& n) {
  using Long = long double;
  const auto reach = [&](const ExactBox& box) {
    const Matrix3<Long> r = rotation_matrix<Long>(box.orientation.cast<Long>());
    return (r.transpose() * n.cast<Long>()).cwiseAbs().dot(box.half.cast<Long>());
  };
  return n.cast<Long>().dot(b.position.cast<Long>() - a.position.cast<Long>()) - reach(a) - reach(b);
}

/// How far a point is outside a box, m.
double outside(const PosedBox& box, const Vector& x) {
  return (box.pose.to_body(x).cwiseAbs() - box.half).cwiseMax(0).norm();
}

std::string describe(const BoxPairCase& pair) {
  std::ostringstream text;
  text.precision(17);
  text << pair.what;
  for (const ExactBox* box : {&pair.a, &pair.b}) {
    text << " | " << box->half.transpose() << " at " << box->position.transpose() << " q " << box->orientation.transpose();
  }
  return text.str();
}

void judge(const BoxPairCase& pair) {
  const ExactDistance exact = exact_distance(pair.a, pair.b);
  const PosedBox a = pair.a.posed(), b = pair.b.posed();
  const Distance d = boxes_distance(at(a), at(b));
  const double larger = std::max(a.half.maxCoeff(), b.half.maxCoeff());
  const double smaller = std::min(a.half.minCoeff(), b.half.minCoeff());
  const double tolerance = 1e-9 * smaller;
  SCOPED_TRACE(describe(pair));
  ASSERT_NEAR(double(d.distance - exact.distance), 0, tolerance) << "exact: " << double(exact.distance);
  const bool overlap = boxes_overlap(at(a), at(b));
  if (std::abs(exact.distance) > 1e-14L * larger) {
    ASSERT_EQ(overlap, exact.sign < 0);
  }
  ASSERT_EQ(overlap, d.distance <= 0);
  ASSERT_NEAR(d.normal.norm(), 1, 1e-14);
  // Moving B by the depth separates; apart, the shadows on the normal are as far apart as the boxes.
  ASSERT_GE(double(shadow_gap(pair.a, pair.b, -d.normal) - exact.distance), -tolerance);
  ASSERT_LE(outside(a, d.on_a), tolerance);
  ASSERT_LE(outside(b, d.on_b), tolerance);
  ASSERT_LE((d.on_a - d.on_b - d.distance * d.normal).norm(), tolerance);
  if (a.half == b.half && a.pose.position == b.pose.position && a.pose.rotation == b.pose.rotation) return;
  const Distance mirrored = boxes_distance(at(b), at(a));
  ASSERT_EQ(mirrored.distance, d.distance);
  ASSERT_EQ(mirrored.normal, -d.normal);
  ASSERT_EQ(mirrored.on_a, d.on_b);
  ASSERT_EQ(mirrored.on_b, d.on_a);
  ASSERT_EQ(boxes_overlap(at(b), at(a)), overlap);
}

void judge_many(std::uint64_t seed, std::uint64_t count) {
  BoxPairs pairs(seed);
  for (std::uint64_t k = 0; k < count; ++k) {
    judge(pairs(k));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(BoxSat, IsRightOnRandomAndDegeneratePairs) { judge_many(1, 2000); }
TEST(BoxSat, IsRightOnManyRandomAndDegeneratePairsSlow) { judge_many(2, 100000); }

TEST(BoxSat, LanesSayWhatOnePairAtATimeSays) {
  BoxPairs make(3);
  std::vector<PosedBox> boxes;
  std::vector<BodyPair> pairs;
  for (std::uint32_t k = 0; k < 4003; ++k) {  // not a multiple of the lanes
    const BoxPairCase pair = make(k);
    boxes.push_back(pair.a.posed());
    boxes.push_back(pair.b.posed());
    pairs.push_back({2 * k, 2 * k + 1});
  }
  std::vector<std::uint8_t> overlap(pairs.size());
  boxes_overlap(boxes, pairs, overlap);
  int together = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    ASSERT_EQ(bool(overlap[k]), boxes_overlap(at(boxes[2 * k]), at(boxes[2 * k + 1]))) << k;
    together += overlap[k];
  }
  EXPECT_GT(together, 1000);
  EXPECT_LT(together, 3000);
  EXPECT_THROW(boxes_overlap(boxes, pairs, std::span(overlap).first(1)), std::invalid_argument);
}

TEST(BoxSat, PublishedCases) {
  std::ifstream file(std::string(POLHODE_TESTS_DIR) + "/collision/collision_cases.csv");
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
    judge(pair);
    if (!std::isnan(x[20])) {
      const PosedBox a = pair.a.posed(), b = pair.b.posed();
      EXPECT_NEAR(boxes_distance(at(a), at(b)).distance, x[20], x[21]) << name;
      EXPECT_NEAR(double(exact_distance(pair.a, pair.b).distance), x[20], x[21]) << name;
    }
    ++count;
  }
  EXPECT_EQ(count, 42);
}

TEST(BoxSat, ARigidMotionOfThePairChangesRoundOffOnly) {
  BoxPairs make(4), motions(5);
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const BoxPairCase pair = make(k);
    const PosedBox a = pair.a.posed(), b = pair.b.posed();
    const double size = std::max(a.half.maxCoeff(), b.half.maxCoeff());
    const Pose motion{size * motions(k).a.position.normalized(), rotation_matrix<double>(motions(k + 1).b.orientation)};
    if (!motion.position.allFinite()) continue;
    const auto moved = [&](const PosedBox& box) {
      return PosedBox{box.half, {motion.to_world(box.pose.position), motion.rotation * box.pose.rotation}};
    };
    const PosedBox moved_a = moved(a), moved_b = moved(b);
    const double before = boxes_distance(at(a), at(b)).distance, after = boxes_distance(at(moved_a), at(moved_b)).distance;
    const double scale = size + (b.pose.position - a.pose.position).norm() + a.pose.position.norm();
    ASSERT_NEAR(after, before, 1e-14 * scale) << describe(pair);
  }
}

TEST(BoxSat, SaysWhatIsWrong) {
  PosedBox a, b;
  b.pose.position[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(boxes_overlap(at(a), at(b)), std::invalid_argument);
  EXPECT_THROW(boxes_distance(at(a), at(b)), std::invalid_argument);
  b.pose.position[1] = 0;
  b.pose.rotation(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(boxes_overlap(at(a), at(b)), std::invalid_argument);
  EXPECT_THROW(boxes_overlap(at(b), at(a)), std::invalid_argument);
  EXPECT_THROW(boxes_distance(at(b), at(a)), std::invalid_argument);
}

TEST(ExactBoxes, KnowsWhatIsKnown) {
  const ExactBox cube{{0.5, 0.5, 0.5}, {0, 0, 0}, {1, 0, 0, 0}};
  ExactBox other = cube;
  other.position = {1, 0, 0};
  EXPECT_EQ(exact_distance(cube, other).sign, 0);
  other.position[0] = 1 + 0x1p-52;
  EXPECT_EQ(exact_distance(cube, other).sign, 1);
  EXPECT_EQ(double(exact_distance(cube, other).distance), 0x1p-52);
  other.position[0] = 1 - 0x1p-53;
  EXPECT_EQ(exact_distance(cube, other).sign, -1);
  other.position = {3, 4, 0};
  EXPECT_NEAR(double(exact_distance(cube, other).distance), std::sqrt(4.0 + 9), 1e-16);
  other.position = {0, 0, 1.5};
  other.orientation = {1, 1, 1, 0};  // a turn by 2 atan(√2) about (1, 1, 0): a vertex straight down would be atan(√2)
  EXPECT_LT(double(exact_distance(cube, other).distance), 0.5);
}

}  // namespace
}  // namespace polhode
