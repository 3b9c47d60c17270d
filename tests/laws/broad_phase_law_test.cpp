// SPDX-License-Identifier: BSD-3-Clause
// The duties of every broad phase of the catalogue: report the pairs that brute force finds, sorted, none twice,
// whatever the boxes are and however they move; refuse what is no box; and allocate nothing once a scene goes on as it
// began.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "collision/broad_phase.hpp"
#include "core/math/portable_random.hpp"
#include "tests/laws/allocations.hpp"

namespace polhode {

void PrintTo(const BodyPair& p, std::ostream* out) { *out << "(" << p.a << ", " << p.b << ")"; }
void PrintTo(const BroadPhaseEntry& e, std::ostream* out) { *out << e.name; }

namespace broad_phase_law_test {
namespace {

using Vector = Vector3<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Written apart from the code under test: closed intervals, axis by axis.
std::vector<BodyPair> by_brute_force(const std::vector<Bounds>& boxes) {
  std::vector<BodyPair> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      bool apart = false;
      for (int k = 0; k < 3; ++k) {
        apart = apart || boxes[a].max()[k] < boxes[b].min()[k] || boxes[b].max()[k] < boxes[a].min()[k];
      }
      if (!apart) pairs.push_back({a, b});
    }
  }
  return pairs;
}

std::vector<BodyPair> answer(BroadPhase& phase, const std::vector<Bounds>& boxes) {
  phase.update(boxes);
  const auto pairs = phase.pairs();
  return {pairs.begin(), pairs.end()};
}

Bounds box(const Vector& centre, const Vector& half) { return {centre - half, centre + half}; }

class BroadPhaseLaw : public ::testing::TestWithParam<BroadPhaseEntry> {
 protected:
  std::unique_ptr<BroadPhase> phase = GetParam().make();

  void expect_right(const std::vector<Bounds>& boxes, const std::string& what) {
    const auto expected = by_brute_force(boxes), found = answer(*phase, boxes);
    ASSERT_EQ(found.size(), expected.size()) << what;
    ASSERT_TRUE(found == expected) << what;
  }
};

std::vector<Bounds> random_boxes(PortableRandom& random, std::size_t n, double edge, double half_low,
                                 double half_high) {
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector centre = random.uniform_vector(0, edge);
    boxes.push_back(box(centre, random.uniform_vector(half_low, half_high)));
  }
  return boxes;
}

TEST_P(BroadPhaseLaw, KnowsNoneAndOneAndTwo) {
  expect_right({}, "no body");
  expect_right({box({1, 2, 3}, {1, 1, 1})}, "one body");
  expect_right({box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {1, 1, 1})}, "two bodies");
  expect_right({box({0, 0, 0}, {1, 1, 1}), box({5, 0, 0}, {1, 1, 1})}, "two bodies apart");
  expect_right({}, "no body again");
}

TEST_P(BroadPhaseLaw, NothingIsAskedBeforeTheFirstStep) { EXPECT_TRUE(phase->pairs().empty()); }

TEST_P(BroadPhaseLaw, FindsThePairsOfRandomBoxes) {
  PortableRandom random(1);
  for (const std::size_t n : {3u, 10u, 100u, 700u}) {
    for (const double edge : {0.0, 1.0, 10.0, 40.0}) {
      expect_right(random_boxes(random, n, edge, 0.1, 1), std::to_string(n) + " in " + std::to_string(edge));
    }
  }
}

TEST_P(BroadPhaseLaw, FollowsManySteps) {
  PortableRandom random(2);
  for (const double step : {0.001, 0.02, 0.2, 3.0}) {
    const std::size_t n = 300;
    const double edge = 12;
    std::vector<Vector> centres, halves, velocities;
    for (std::size_t i = 0; i < n; ++i) {
      centres.push_back(random.uniform_vector(0, edge));
      halves.push_back(random.uniform_vector(0.2, 0.8));
      velocities.push_back(random.uniform_vector(-1, 1));
    }
    for (int k = 0; k < 60; ++k) {
      std::vector<Bounds> boxes;
      for (std::size_t i = 0; i < n; ++i) {
        centres[i] += step * velocities[i];
        for (int axis = 0; axis < 3; ++axis) {
          if (centres[i][axis] < 0 || centres[i][axis] > edge) velocities[i][axis] = -velocities[i][axis];
        }
        boxes.push_back(box(centres[i], halves[i] * (1 + 0.3 * std::sin(0.2 * k + double(i)))));
      }
      expect_right(boxes, "steps of " + std::to_string(step) + ", number " + std::to_string(k));
    }
  }
}

TEST_P(BroadPhaseLaw, FollowsASceneThatFliesApartAndComesBack) {
  PortableRandom random(3);
  const auto start = random_boxes(random, 250, 5, 0.1, 0.5);
  for (int k = 0; k < 40; ++k) {
    const double grow = std::exp(12 * std::sin(std::numbers::pi * k / 39));
    std::vector<Bounds> boxes;
    for (const Bounds& b : start) boxes.push_back(box(grow * b.center(), 0.5 * b.sizes()));
    expect_right(boxes, "step " + std::to_string(k));
  }
}

TEST_P(BroadPhaseLaw, FollowsABoxThroughACrowdThatRests) {
  PortableRandom random(4);
  auto boxes = random_boxes(random, 300, 15, 0.2, 0.6);
  for (int k = 0; k < 100; ++k) {
    boxes[17] = box({0.2 * k - 2, 0.15 * k, 7}, {1, 1, 1});
    expect_right(boxes, "step " + std::to_string(k));
  }
}

TEST_P(BroadPhaseLaw, FollowsAColumnThatFalls) {
  for (int k = 0; k < 80; ++k) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < 200; ++i) boxes.push_back(box({0.01 * i, 0, 1.01 * i - 0.5 * k}, {0.5, 0.5, 0.5}));
    boxes.emplace_back(Vector(-infinity, -infinity, -infinity), Vector(infinity, infinity, 0));
    expect_right(boxes, "step " + std::to_string(k));
  }
}

TEST_P(BroadPhaseLaw, FindsThePairsOfClusters) {
  PortableRandom random(5);
  std::vector<Vector> at;
  for (int c = 0; c < 5; ++c) at.push_back(random.uniform_vector(-1e6, 1e6));
  for (int k = 0; k < 10; ++k) {
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < 400; ++i) {
      const Vector centre = at[i % at.size()] + random.uniform_vector(-2, 2);
      boxes.push_back(box(centre, random.uniform_vector(0.05, 0.3)));
    }
    expect_right(boxes, "step " + std::to_string(k));
  }
}

TEST_P(BroadPhaseLaw, FindsAllPairsOfIdenticalBoxes) {
  expect_right(std::vector<Bounds>(150, box({1, 2, 3}, {0.5, 0.5, 0.5})), "boxes");
  expect_right(std::vector<Bounds>(150, box({1, 2, 3}, {0, 0, 0})), "points");
  expect_right(std::vector<Bounds>(150, box({0, 0, 0}, {0, 0, 0})), "points at the origin");
}

TEST_P(BroadPhaseLaw, BoxesThatTouchAreAPair) {
  std::vector<Bounds> boxes;  // boxes of a lattice: each touches 26 others
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      for (int z = 0; z < 6; ++z) boxes.emplace_back(Vector(x, y, z), Vector(x + 1, y + 1, z + 1));
    }
  }
  for (const double scale : {1.0, 1.0 / 3, 1e-300, 1e300, 0x1p-40, 1e9}) {
    auto scaled = boxes;
    for (Bounds& b : scaled) b = Bounds(scale * b.min(), scale * b.max());
    expect_right(scaled, "lattice times " + std::to_string(scale));
    for (Bounds& b : scaled) {  // a gap of one unit in the last place
      for (int k = 0; k < 3; ++k) b.max()[k] = std::nextafter(b.max()[k], -infinity);
    }
    expect_right(scaled, "lattice with gaps, times " + std::to_string(scale));
  }
  std::vector<Bounds> flat;  // boxes without volume: plates, needles and points on one another's edges
  for (int i = 0; i < 50; ++i) {
    flat.emplace_back(Vector(i, 0, 0), Vector(i + 1, 1, 0));
    flat.emplace_back(Vector(i, 1, 0), Vector(i, 1, 3));
    flat.emplace_back(Vector(i, 1, 3), Vector(i, 1, 3));
  }
  expect_right(flat, "plates, needles and points");
}

/// True if a box is in one cell, or in several that are disjoint and share its volume out; up to rounding.
bool held(const Bounds& box, const std::vector<Bounds>& cells) {
  const double slack = 1e-9 * (1 + box.min().cwiseAbs().maxCoeff() + box.max().cwiseAbs().maxCoeff());
  double shared = 0;
  for (const Bounds& cell : cells) {
    if (((cell.min() - box.min()).array() <= slack).all() && ((box.max() - cell.max()).array() <= slack).all())
      return true;
    const Bounds common = cell.intersection(box);
    if (!common.isEmpty()) shared += common.volume();
  }
  return shared >= (1 - 1e-9) * box.volume();
}

// The cells are for drawing only. All finite boxes are in them, through the motion and beside boxes without an end.
TEST_P(BroadPhaseLaw, ItsCellsHoldWhatIsFinite) {
  PortableRandom random(11);
  std::vector<Bounds> none;
  phase->cells(none);
  EXPECT_TRUE(none.empty()) << "nothing has been asked";
  const auto start = random_boxes(random, 150, 6, 0.1, 0.5);
  bool some = false;
  for (int k = 0; k < 20; ++k) {
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < start.size(); ++i) {
      boxes.push_back(
          box(start[i].center() * (1 + 0.1 * k * double(i % 3)), 0.5 * start[i].sizes() * (i == 7 ? 20 : 1)));
    }
    boxes.emplace_back(Vector(-infinity, -infinity, -infinity), Vector(infinity, infinity, 0));
    answer(*phase, boxes);
    std::vector<Bounds> cells(1, Bounds(Vector(0, 0, 0), Vector(1, 1, 1)));
    phase->cells(cells);
    EXPECT_EQ(cells.front().max(), Vector(1, 1, 1)) << "they are appended";
    cells.erase(cells.begin());
    if (cells.empty()) break;
    some = true;
    for (const Bounds& cell : cells) {
      ASSERT_TRUE(cell.min().allFinite() && cell.max().allFinite() && (cell.sizes().array() >= 0).all());
    }
    for (std::size_t i = 0; i + 1 < boxes.size(); ++i)
      ASSERT_TRUE(held(boxes[i], cells)) << "box " << i << ", step " << k;
  }
  const std::string& name = GetParam().name;
  EXPECT_EQ(some, name != "all_pairs" && name != "sweep_and_prune");
}

// Two cells of the grid are apart, or one is in the other, on a coarser level; the parts of space are apart.
TEST_P(BroadPhaseLaw, CellsThatDivideSpaceAreApart) {
  const std::string& name = GetParam().name;
  if (name != "uniform_grid" && name != "bsp_tree") GTEST_SKIP() << "its cells are the nodes of a tree";
  PortableRandom random(12);
  auto boxes = random_boxes(random, 200, 8, 0.1, 0.5);
  boxes[3] = box({2, 2, 2}, {3, 3, 3});
  answer(*phase, boxes);
  std::vector<Bounds> cells;
  phase->cells(cells);
  ASSERT_GT(cells.size(), 10u);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector common = cells[i].intersection(cells[j]).sizes();
      if (common.minCoeff() < 1e-9) continue;
      const double smaller = std::min(cells[i].volume(), cells[j].volume());
      ASSERT_EQ(name, "uniform_grid") << i << " and " << j;
      ASSERT_NEAR(common.prod(), smaller, 1e-9 * smaller) << i << " and " << j;
      ASSERT_NE(cells[i].volume(), cells[j].volume()) << "none stands twice";
    }
  }
}

TEST_P(BroadPhaseLaw, NegativeZeroIsZero) {
  expect_right({Bounds(Vector(-1, -1, -1), Vector(-0.0, -0.0, -0.0)), Bounds(Vector(0.0, 0.0, 0.0), Vector(1, 1, 1)),
                Bounds(Vector(0.0, 0.0, 0.0), Vector(-0.0, -0.0, -0.0))},
               "zeros");
}

TEST_P(BroadPhaseLaw, BoundsMayBeInfinite) {
  PortableRandom random(6);
  auto boxes = random_boxes(random, 200, 10, 0.1, 0.8);
  boxes.emplace_back(Vector(-infinity, -infinity, -infinity), Vector(infinity, infinity, 1));
  boxes.insert(boxes.begin() + 50, Bounds(Vector(3, 3, -infinity), Vector(4, 4, infinity)));
  boxes.insert(boxes.begin() + 90,
               Bounds(Vector(-infinity, -infinity, -infinity), Vector(infinity, infinity, infinity)));
  boxes.insert(boxes.begin() + 95, Bounds(Vector(infinity, 0, 0), Vector(infinity, 1, 1)));
  boxes.insert(boxes.begin() + 99, Bounds(Vector(5, 5, 5), Vector(infinity, infinity, infinity)));
  boxes.emplace_back(Vector(-infinity, -infinity, -infinity), Vector(-infinity, -infinity, -infinity));
  for (int k = 0; k < 20; ++k) {
    expect_right(boxes, "step " + std::to_string(k));
    for (Bounds& b : boxes) b.translate(random.uniform_vector(-0.1, 0.1));
  }
  std::vector<Bounds> everywhere(40, Bounds(Vector::Constant(-infinity), Vector::Constant(infinity)));
  expect_right(everywhere, "all without end");
  for (Bounds& b : everywhere) b.min().x() = random.uniform(-1, 1);
  for (Bounds& b : everywhere) b.max().y() = random.uniform(-1, 1);
  expect_right(everywhere, "half-spaces");
}

TEST_P(BroadPhaseLaw, CoordinatesMayBeHuge) {
  PortableRandom random(7);
  for (const double far : {1e8, 1e15, 1e150, 1e307}) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < 150; ++i) {
      const Vector centre = far * random.uniform_vector(-1, 1);
      boxes.push_back(box(centre, far * random.uniform_vector(0, 0.1)));
      boxes.push_back(box(centre, random.uniform_vector(0, 1)));
      boxes.push_back(box(random.uniform_vector(-5, 5), random.uniform_vector(0, 1)));
    }
    for (int k = 0; k < 5; ++k) {
      expect_right(boxes, "as far as " + std::to_string(far));
      for (Bounds& b : boxes) b.translate(random.uniform_vector(-1, 1));
    }
  }
  constexpr double most = std::numeric_limits<double>::max();
  expect_right(
      {Bounds(Vector::Constant(-most), Vector::Constant(most)), Bounds(Vector::Constant(most), Vector::Constant(most)),
       Bounds(Vector::Constant(-1), Vector::Constant(1)), Bounds(Vector::Constant(-most), Vector::Constant(-most))},
      "the largest numbers");
}

TEST_P(BroadPhaseLaw, SizesMaySpanSixOrders) {
  PortableRandom random(8);
  std::vector<Bounds> boxes;
  for (int i = 0; i < 700; ++i) {
    const double size = random.power_of_ten(-4, 2);
    const Vector centre = random.uniform_vector(-50, 50);
    boxes.push_back(box(centre, size * random.uniform_vector(0.1, 1)));
  }
  for (int k = 0; k < 20; ++k) {
    expect_right(boxes, "step " + std::to_string(k));
    for (Bounds& b : boxes) b.translate(random.uniform_vector(-0.3, 0.3));
  }
}

TEST_P(BroadPhaseLaw, SmallBoxesMayLieWithinALargeOne) {
  PortableRandom random(9);
  auto boxes = random_boxes(random, 300, 1, 1e-3, 1e-2);
  boxes.push_back(box({0.5, 0.5, 0.5}, {10, 10, 10}));
  boxes.push_back(box({0.5, 0.5, 0.5}, {1e4, 1e4, 1e-4}));
  for (int k = 0; k < 10; ++k) {
    expect_right(boxes, "step " + std::to_string(k));
    for (Bounds& b : boxes) b.translate(random.uniform_vector(-0.01, 0.01));
  }
}

TEST_P(BroadPhaseLaw, SizesMayChange) {
  PortableRandom random(10);
  auto boxes = random_boxes(random, 200, 10, 0.1, 0.4);
  for (int k = 0; k < 30; ++k) {
    expect_right(boxes, "step " + std::to_string(k));
    for (Bounds& b : boxes) b = box(b.center(), b.sizes() * (k % 10 < 5 ? 1.1 : 0.9));
    boxes[3] =
        k % 3 == 0 ? Bounds(Vector::Constant(-infinity), Vector(infinity, infinity, 2)) : box({5, 5, 5}, {0, 0, 0});
  }
}

TEST_P(BroadPhaseLaw, AnotherNumberOfBodiesIsANewScene) {
  PortableRandom random(11);
  for (const std::size_t n : {100u, 101u, 40u, 0u, 1u, 300u, 299u}) {
    auto boxes = random_boxes(random, n, 6, 0.1, 0.5);
    for (int k = 0; k < 3; ++k) {
      expect_right(boxes, std::to_string(n) + " bodies");
      for (Bounds& b : boxes) b.translate(random.uniform_vector(-0.1, 0.1));
    }
  }
}

TEST_P(BroadPhaseLaw, ASceneMayJump) {
  PortableRandom random(12);
  for (int k = 0; k < 8; ++k) {
    expect_right(random_boxes(random, 300, 10, 0.1, 0.5), "scene " + std::to_string(k));
  }
}

TEST_P(BroadPhaseLaw, AScenesAxesMayAllBeTheWidest) {
  PortableRandom random(13);
  for (int k = 0; k < 6; ++k) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < 200; ++i) {
      Vector centre = random.uniform_vector(0, 0.5);
      centre[k % 3] = random.uniform(0, 50);
      boxes.push_back(box(centre, random.uniform_vector(0.1, 0.5)));
    }
    expect_right(boxes, "along axis " + std::to_string(k % 3));
  }
}

TEST_P(BroadPhaseLaw, RefusesWhatIsNoBox) {
  PortableRandom random(14);
  const auto good = random_boxes(random, 30, 3, 0.1, 0.5);
  const auto expected = answer(*phase, good);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int side = 0; side < 2; ++side) {
    for (int k = 0; k < 3; ++k) {
      auto bad = good;
      (side == 0 ? bad[12].min() : bad[12].max())[k] = nan;
      try {
        phase->update(bad);
        FAIL() << "a NaN was let through";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("body 12 have a NaN"), std::string::npos) << error.what();
      }
      bad = good;
      bad[5].min()[k] = 9;
      EXPECT_THROW(phase->update(bad), std::invalid_argument) << "a box that ends before it begins";
    }
  }
  EXPECT_THROW(phase->update(std::vector<Bounds>(3)), std::invalid_argument) << "boxes with nothing in them";
  EXPECT_TRUE(answer(*phase, good) == expected) << "a scene goes on after a refusal";
}

TEST_P(BroadPhaseLaw, PairsMayBeAskedAgain) {
  PortableRandom random(15);
  auto boxes = random_boxes(random, 100, 5, 0.1, 0.5);
  const auto first = answer(*phase, boxes);
  const auto again = phase->pairs();
  EXPECT_TRUE(std::vector<BodyPair>(again.begin(), again.end()) == first);
  phase->update(boxes);
  phase->update(boxes);
  for (Bounds& b : boxes) b.translate(Vector(0.5, 0, 0));
  phase->update(boxes);
  boxes.pop_back();  // steps after which no pairs were read
  phase->update(boxes);
  expect_right(boxes, "after steps without a question");
}

TEST_P(BroadPhaseLaw, TheCallersBoundsMayGoAfterTheUpdate) {
  PortableRandom random(16);
  auto boxes = random_boxes(random, 100, 5, 0.1, 0.5);
  const auto expected = by_brute_force(boxes);
  phase->update(boxes);
  for (Bounds& b : boxes) b = box({0, 0, 0}, {9, 9, 9});
  const auto pairs = phase->pairs();
  EXPECT_TRUE(std::vector<BodyPair>(pairs.begin(), pairs.end()) == expected);
}

/// Boxes that move about places of their own.
std::vector<Bounds> swaying(const std::vector<Bounds>& places, double t, double reach) {
  std::vector<Bounds> boxes = places;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double phase = 0.7 * static_cast<double>(i);
    boxes[i].translate(reach * Vector(std::sin(t + phase), std::cos(t + 1.3 * phase), std::sin(t + 2.1 * phase)));
  }
  return boxes;
}

TEST_P(BroadPhaseLaw, ASteadySceneAllocatesNothingAfterItsFirstStep) {
  PortableRandom random(17);
  const auto places = random_boxes(random, 1000, 12, 0.2, 0.6);
  for (const double reach : {0.0, 0.01, 0.2, 1.0}) {
    std::vector<std::vector<Bounds>> steps;
    for (int k = 0; k < 60; ++k) steps.push_back(swaying(places, 0.15 * k, reach));
    auto fresh = GetParam().make();
    fresh->update(steps[0]);
    std::size_t pairs = fresh->pairs().size();
    for (std::size_t k = 1; k < steps.size(); ++k) {
      const std::size_t before = allocations();
      fresh->update(steps[k]);
      pairs += fresh->pairs().size();
      ASSERT_EQ(allocations() - before, 0u) << "step " << k << " of a motion by " << reach;
    }
    EXPECT_GT(pairs, 0u);
  }
}

TEST_P(BroadPhaseLaw, TheSameMotionGivesTheSameBytes) {
  PortableRandom random(18);
  const auto places = random_boxes(random, 200, 6, 0.2, 0.6);
  auto other = GetParam().make();
  for (int k = 0; k < 20; ++k) {
    const auto boxes = swaying(places, 0.3 * k, 0.4);
    ASSERT_TRUE(answer(*phase, boxes) == answer(*other, boxes)) << "step " << k;
  }
}

TEST_P(BroadPhaseLaw, HasANameAndASummary) {
  EXPECT_FALSE(GetParam().summary.empty());
  const BroadPhaseEntry* found = find_broad_phase(GetParam().name);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->name, GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, BroadPhaseLaw, ::testing::ValuesIn(broad_phase_catalogue()),
                         [](const auto& phase) { return phase.param.name; });

TEST(BroadPhaseCatalogue, UnknownNamesAreNotFound) { EXPECT_EQ(find_broad_phase("magic"), nullptr); }

}  // namespace
}  // namespace broad_phase_law_test
}  // namespace polhode
