// SPDX-License-Identifier: BSD-3-Clause
// `sat` on boxes against the exact judge, on random and degenerate pairs and on published cases; its symmetry; lanes.
#include "collision/narrow/box_sat.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "collision/narrow_phase.hpp"
#include "tests/collision/narrow/box_judge.hpp"
#include "tests/collision/narrow/exact_boxes.hpp"

namespace polhode::box_sat_test {
namespace {

using Vector = Vector3<double>;

BoxAt at(const PosedBox& box) { return {box.half, box.pose}; }

const NarrowPhase& sat_phase() {
  static const auto narrow = find_narrow_phase("sat")->make();
  return *narrow;
}

TEST(BoxSat, IsRightOnRandomAndDegeneratePairs) { judge_many(sat_phase(), 1, 2000, 1e-9); }
TEST(BoxSat, IsRightOnManyRandomAndDegeneratePairsSlow) { judge_many(sat_phase(), 2, 100000, 1e-9); }

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

TEST(BoxSat, PublishedCases) { judge_published(sat_phase(), 1e-9); }

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
    const double before = boxes_distance(at(a), at(b)).distance,
                 after = boxes_distance(at(moved_a), at(moved_b)).distance;
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
}  // namespace polhode::box_sat_test
