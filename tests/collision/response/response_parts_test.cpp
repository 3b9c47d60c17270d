// SPDX-License-Identifier: BSD-3-Clause
// The parts of the responses: the complementarity problem, the cone, the parabola of energy, the batches, the
// forces of the step before.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "collision/response/complementarity.hpp"
#include "collision/response/contact_batches.hpp"
#include "collision/response/energy_guard.hpp"
#include "collision/response/friction_cone.hpp"
#include "collision/response/islands.hpp"
#include "collision/response/sequential_impulses.hpp"
#include "collision/response/warm_start.hpp"
#include "core/math/portable_random.hpp"
#include "tests/laws/impulse_scenes.hpp"

namespace polhode::response_parts_test {
namespace {

TEST(Complementarity, SolvesAProblemOfThree) {
  // Without the sign the third would be negative: by hand, with j3 = 0, 2 j1 + j2 = 3, j1 + 2 j2 = 3.
  Eigen::MatrixXd a(3, 3);
  a << 2, 1, 1, 1, 2, 1, 1, 1, 2;
  Eigen::VectorXd b(3), j = Eigen::VectorXd::Zero(3);
  b << -3, -3, 1;
  Complementarity problem;
  ASSERT_TRUE(problem.solve(a, b, j));
  EXPECT_NEAR(j[0], 1, 1e-15);
  EXPECT_NEAR(j[1], 1, 1e-15);
  EXPECT_EQ(j[2], 0);
}

TEST(Complementarity, SolvesProblemsOfEveryRank) {
  Complementarity problem;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    PortableRandom random(seed);
    const Eigen::Index size = 1 + random.below(20), rank = 1 + random.below(12);
    Eigen::MatrixXd jacobian(size, rank);
    Eigen::VectorXd motion(rank), b(size), j = Eigen::VectorXd::Zero(size);
    for (Eigen::Index k = 0; k < rank; ++k) motion[k] = random.uniform(-1, 1);
    for (Eigen::Index i = 0; i < size; ++i) {
      for (Eigen::Index k = 0; k < rank; ++k) jacobian(i, k) = random.uniform(-1, 1);
      if (i > 0 && random.chance(0.3)) jacobian.row(i) = jacobian.row(i - 1);  // the same again
      b[i] = random.chance(0.3) ? random.uniform(0, 0.5) : 0;                  // a gap
      if (random.chance(0.3)) j[i] = random.uniform(0, 1);                     // a start that is not zero
    }
    const Eigen::MatrixXd a = jacobian * jacobian.transpose();
    b += jacobian * motion;
    ASSERT_TRUE(problem.solve(a, b, j)) << seed;
    const Eigen::VectorXd w = a * j + b;
    const double scale = 1 + j.cwiseAbs().maxCoeff() * a.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < size; ++i) {
      ASSERT_GE(j[i], 0) << seed;
      ASSERT_GE(w[i], -1e-9 * scale) << seed;
      ASSERT_LE(std::min(j[i], w[i]), 1e-9 * scale) << seed;
    }
  }
}

TEST(FrictionCone, ComesToRestAgainstTheSlip) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    PortableRandom random(seed);
    const double tt = random.uniform(1, 3), bb = random.uniform(1, 3), tb = random.uniform(-0.9, 0.9),
                 radius = random.uniform(0, 1);
    const Tangential<double> before{random.uniform(-2, 2), random.uniform(-2, 2)};
    const FrictionCone<double> cone(tt, tb, bb);
    Tangential<double> j{0, 0}, slip = before;
    for (int k = 0; k < 2000; ++k) {
      j = cone.step(j, slip, radius);
      slip = {before.t + tt * j.t + tb * j.b, before.b + tb * j.t + bb * j.b};
    }
    const double length = std::hypot(j.t, j.b), speed = std::hypot(slip.t, slip.b);
    ASSERT_LE(length, radius * (1 + 1e-14));
    ASSERT_NEAR(radius * slip.t + speed * j.t, 0, 1e-12);
    ASSERT_NEAR(radius * slip.b + speed * j.b, 0, 1e-12);
  }
}

TEST(FrictionCone, TakesNothingFromWhatCannotMove) {
  const Tangential<double> j = FrictionCone<double>(0, 0, 0).step({0, 0}, {1, 2}, 3);
  EXPECT_EQ(j.t, 0);
  EXPECT_EQ(j.b, 0);
}

TEST(EnergyGuard, FindsWhereTheParabolaEndsAtZero) {
  EXPECT_EQ(share_without_gain(-1, 5, -0.5), 1);
  EXPECT_NEAR(share_without_gain(-1, 0, 3), 0.5, 1e-15);                            // 4 s² − 1
  EXPECT_NEAR(share_without_gain(0, -1, 1), 0.5, 1e-15);                            // 2 s² − s
  EXPECT_NEAR(share_without_gain(-1, 1.5, 1), 2 / (1.5 + std::sqrt(4.25)), 1e-15);  // s²/2 + 1.5 s − 1
  EXPECT_EQ(share_without_gain(0, 1, 3), 0);
  EXPECT_EQ(share_without_gain(0, 0, 0), 1);
}

TEST(ContactBatches, NoTwoLanesShareABodyThatMoves) {
  PortableRandom random(3);
  const laws::ImpulseScene s = laws::random_scene(random, {.bodies = 40, .statics = 0.1});
  ContactBatches batches;
  batches.build(s.bodies, s.contacts);
  std::vector<int> found(s.contacts.size(), 0);
  for (const PatchBatch& patch : batches.patches()) {
    std::multiset<std::uint32_t> moving;
    for (std::size_t i = 0; i < lane_count; ++i) {
      for (const std::uint32_t body : {patch.a[i], patch.b[i]}) {
        if (body < s.bodies.size() && s.bodies[body].moves()) moving.insert(body);
      }
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        const std::uint32_t number = batches.contacts()[k][i];
        if (number == ContactBatches::none) continue;
        ++found[number];
        ASSERT_EQ(s.contacts[number].a, patch.a[i]);
        ASSERT_EQ(s.contacts[number].b, patch.b[i]);
      }
    }
    ASSERT_EQ(moving.size(), std::set<std::uint32_t>(moving.begin(), moving.end()).size());
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const ImpulseContact& c = s.contacts[i];
    ASSERT_EQ(found[i], s.bodies[c.a].moves() || s.bodies[c.b].moves() ? 1 : 0);
  }
}

TEST(ContactBatches, ABodyWithManyNeighboursHasThemAll) {
  laws::ImpulseScene s;
  s.bodies.push_back(laws::ball(1, 1, Vector3<double>::Zero()));
  PortableRandom random(4);
  for (std::uint32_t k = 1; k <= 150; ++k) {
    const Vector3<double> out = random.direction();
    s.bodies.push_back(laws::ball(1, 0.1, 1.1 * out));
    s.bodies.back().velocity = -out;
    ImpulseContact c;
    c.b = k;
    c.normal = -out;
    c.point = out;
    s.contacts.push_back(c);
  }
  s.meet();
  make_sequential_impulses({})->resolve(s.bodies, s.contacts, 0);
  for (const ImpulseContact& c : s.contacts) EXPECT_GE(c.normal.dot(s.relative(c)), -1e-5);
}

TEST(Islands, EndAtWhatCannotMove) {
  const ImpulseBody wall, moves = laws::ball(1, 1, Vector3<double>::Zero());
  const std::vector<ImpulseBody> bodies = {wall, moves, moves, moves, moves, wall};
  std::vector<ImpulseContact> contacts;
  for (const auto& [a, b] :
       std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {0, 2}, {0, 5}, {1, 4}, {2, 3}, {3, 5}, {4, 5}}) {
    contacts.emplace_back().a = a;
    contacts.back().b = b;
  }
  Islands islands;
  islands.build(bodies, contacts);
  ASSERT_EQ(islands.count(), 2u);
  const auto members = [&](std::size_t k) {
    const auto all = islands.contacts(k);
    return std::vector<std::uint32_t>(all.begin(), all.end());
  };
  EXPECT_EQ(members(0), (std::vector<std::uint32_t>{0, 3, 6}));
  EXPECT_EQ(members(1), (std::vector<std::uint32_t>{1, 4, 5}));
  islands.build({}, {});
  EXPECT_EQ(islands.count(), 0u);
}

TEST(WarmStart, FindsForcesByFeatureThenByPlace) {
  const auto contact = [](std::uint32_t a, std::uint32_t b, std::uint32_t feature, double x, double force) {
    ImpulseContact c;
    c.a = a;
    c.b = b;
    c.feature = {Feature::Kind::vertex_face, feature, 0};
    c.point = {x, 0, 0};
    c.impulse = {0, 0, force};
    return c;
  };
  const std::vector<ImpulseBody> bodies(4);
  const std::vector<ImpulseContact> before = {contact(0, 1, 1, 0, 1), contact(0, 1, 2, 1, 2), contact(0, 1, 3, 2, 3),
                                              contact(1, 2, 1, 0, 4), contact(2, 3, 1, 0, 5)};
  // Two of the first pair have changed their features and their order; one pair is new, one is gone, one has a new
  // step.
  std::vector<ImpulseContact> after = {contact(0, 1, 8, 2.1, 0), contact(0, 1, 9, 0.1, 0), contact(0, 1, 2, 7, 0),
                                       contact(0, 1, 7, 1, 9),   contact(0, 2, 1, 0, 9),   contact(2, 3, 1, 0, 0)};
  WarmStart memory;
  memory.remember(bodies, before, 0.1);
  memory.recall(bodies, after, 0.2);
  const std::vector<double> expected = {6, 2, 4, 0, 0, 10};
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_NEAR(after[i].impulse[2], expected[i], 1e-14) << i;
  for (ImpulseContact& c : after) c.wanted = 1;  // an impact
  memory.remember(bodies, after, 0.2);
  memory.recall(bodies, after, 0.2);
  for (const ImpulseContact& c : after) EXPECT_TRUE(c.impulse.isZero(0));
  memory.remember(bodies, before, 0.1);
  memory.forget();
  memory.recall(bodies, after, 0.2);
  for (const ImpulseContact& c : after) EXPECT_TRUE(c.impulse.isZero(0));
}

TEST(SequentialImpulses, OneIterationIsEnoughAtRest) {
  // A step with one iteration keeps the forces that many iterations found for a box that has stood for a while.
  SequentialSettings settings;
  settings.in_step = 1;
  const auto response = make_sequential_impulses(settings);
  laws::ImpulseScene s;
  s.bodies = {ImpulseBody{}, laws::cube(1, 1, {0, 0, 0.5}, Matrix3<double>::Identity())};
  for (std::uint32_t k = 0; k < 4; ++k) {
    ImpulseContact c;
    c.b = 1;
    c.normal = {0, 0, -1};
    c.point = {k % 2 ? 0.5 : -0.5, k / 2 ? 0.5 : -0.5, 0};
    c.friction = 0.5;
    c.feature = {Feature::Kind::face_vertex, 0, k};
    s.contacts.push_back(c);
  }
  double speed = 1;
  for (int k = 0; k < 60; ++k) {
    s.bodies[1].velocity += Vector3<double>(0.02, 0, -0.1);
    response->resolve(s.bodies, s.contacts, 0.01);
    speed = s.bodies[1].velocity.norm();
  }
  EXPECT_LE(speed, 1e-10);
}

}  // namespace
}  // namespace polhode::response_parts_test
