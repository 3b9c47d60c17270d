// SPDX-License-Identifier: BSD-3-Clause
// Each invariant stays along the equations of motion: its derivative in the direction of the rate vanishes, at random
// states of every kind of problem that it takes; and it changes in the problems that it refuses.
#include "core/system/invariants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/math/quaternion.hpp"

namespace polhode::invariants_test {
namespace {

using Vector = Vector3<double>;

struct Top {
  Vector moments = {1, 1, 1};
  Vector center = Vector::Zero();
  bool pinned = true;
  Vector gravity = {0, 0, -9.81};
};

Quaternion<double> random_orientation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Quaternion<double>(normal(random), normal(random), normal(random), normal(random)).normalized();
}

Vector random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

Problem problem_of(const Top& top, std::mt19937& random) {
  Problem problem;
  Body body;
  body.mass = 1.7;
  body.inertia = top.moments.asDiagonal();
  body.pinned = top.pinned;
  body.center_of_mass = top.center;
  BodyStart start;
  start.position = random_vector(random);
  start.orientation = random_orientation(random);
  start.angular_velocity = 2 * random_vector(random);
  if (!top.pinned) start.velocity = random_vector(random);
  problem.bodies = {body};
  problem.starts = {start};
  if (!top.gravity.isZero(0)) problem.forces.push_back({"uniform_gravity", {0}, {{"acceleration", top.gravity}}});
  return problem;
}

/// |dI/dt| along the motion by central differences, over the invariant's scale, 1/s.
double drift_rate(const InvariantKind& kind, const Problem& problem, const Formulation& formulation) {
  const auto system = make_system<double>(problem, formulation);
  const State<double> start = system->start();
  VectorX<double> rate = start.y;
  system->rate(0, start.y.data(), rate.data());
  const double e = 1e-5;
  const auto value = [&](const VectorX<double>& y) { return kind.value(problem, system->snapshot(y, 0)); };
  const double change = (value(start.y + e * rate) - value(start.y - e * rate)) / (2 * e);
  return std::abs(change) / kind.scale(problem, system->snapshot(start.y, 0));
}

const InvariantKind& invariant(const char* name) { return *find_invariant(name); }

std::vector<Formulation> formulations() {
  std::vector<Formulation> all;
  for (const Orientation o : {Orientation::quaternion, Orientation::matrix}) {
    for (const AngularState a :
         {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
      all.push_back({o, a, true, RotationFrom::normalized});
    }
  }
  return all;
}

void expect_conserved(const char* name, const Top& top) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const Problem problem = problem_of(top, random);
    ASSERT_EQ(invariant(name).refusal(problem), "") << name;
    for (const Formulation& f : formulations()) EXPECT_LE(drift_rate(invariant(name), problem, f), 2e-7) << name;
  }
}

/// The check above can fail: in a problem that the invariant refuses, the value moves.
void expect_refused_and_moving(const char* name, const Top& top) {
  std::mt19937 random(1);
  double largest = 0;
  for (int i = 0; i < 20; ++i) {
    const Problem problem = problem_of(top, random);
    EXPECT_NE(invariant(name).refusal(problem), "") << name;
    largest = std::max(largest, drift_rate(invariant(name), problem, {}));
  }
  EXPECT_GE(largest, 1e-2) << name;
}

TEST(Invariants, PhiOfPinnedBodies) {
  expect_conserved("p_phi", {.moments = {1, 2, 2.5}, .center = {0.1, -0.2, 0.4}});
  expect_conserved("p_phi", {.moments = {1, 2, 2.5}, .center = {0.1, -0.2, 0.4}, .gravity = {3, -4, 5}});
  expect_conserved("p_phi", {.moments = {1, 2, 2.5}, .center = {0.1, -0.2, 0.4}, .gravity = {0, 0, 0}});
}

TEST(Invariants, PsiOfSymmetricTops) {
  expect_conserved("p_psi", {.moments = {2, 2, 1}, .center = {0, 0, 0.5}});
  expect_conserved("p_psi", {.moments = {2, 2, 1}, .center = {0, 0, -0.5}, .gravity = {1, 2, 3}});
  expect_conserved("p_psi", {.moments = {2, 2, 1}, .pinned = false});
  expect_refused_and_moving("p_psi", {.moments = {2, 2.1, 1}, .center = {0, 0, 0.5}});
  expect_refused_and_moving("p_psi", {.moments = {2, 2, 1}, .center = {0.1, 0, 0.5}});
}

TEST(Invariants, KovalevskayasIntegral) {
  expect_conserved("kovalevskaya", {.moments = {2, 2, 1}, .center = {0.5, 0, 0}});
  expect_conserved("kovalevskaya", {.moments = {0.6, 0.6, 0.3}, .center = {-0.3, 0, 0}, .gravity = {1, -2, 3}});
  expect_conserved("kovalevskaya", {.moments = {2, 2, 1}, .center = {0.5, 0, 0}, .gravity = {0, 0, 0}});
  expect_refused_and_moving("kovalevskaya", {.moments = {2, 2, 1.1}, .center = {0.5, 0, 0}});
  expect_refused_and_moving("kovalevskaya", {.moments = {2, 2, 1}, .center = {0.5, 0, 0.2}});
  EXPECT_NE(invariant("kovalevskaya").refusal({}), "");
}

TEST(Invariants, CasimirWithoutTorque) {
  expect_conserved("casimir", {.moments = {1, 2, 2.5}, .pinned = false});
  expect_conserved("casimir", {.moments = {1, 2, 2.5}, .pinned = true});
  expect_refused_and_moving("casimir", {.moments = {1, 2, 2.5}, .center = {0, 0, 0.5}});
}

TEST(Invariants, OtherForcesAndBodiesAreRefused) {
  std::mt19937 random(1);
  const Top top = {.moments = {2, 2, 1}, .center = {0.5, 0, 0}};
  Problem pushed = problem_of(top, random);
  pushed.forces.push_back({"constant_torque", {0}, {{"torque", Vector(1, 0, 0)}, {"frame", std::string("world")}}});
  Problem two = problem_of(top, random);
  two.bodies.push_back(two.bodies.front());
  two.starts.push_back(two.starts.front());
  Problem ground = problem_of({.moments = {2, 2, 1}, .center = {0, 0, 0}}, random);
  ground.bodies.push_back(ground.bodies.front());
  ground.bodies.back().fixed = true;
  ground.starts.push_back(ground.starts.front());
  for (const InvariantKind& kind : invariant_catalogue()) {
    EXPECT_NE(kind.refusal(pushed), "") << kind.name;
    EXPECT_NE(kind.refusal(two), "") << kind.name;
    EXPECT_EQ(kind.refusal(ground), "") << kind.name << ": a static body is no second one";
  }
}

TEST(Invariants, ValuesByHand) {
  Problem problem;
  Body body;
  body.inertia = Vector(2, 2, 1).asDiagonal();
  body.pinned = true;
  body.center_of_mass = {0.5, 0, 0};
  BodyStart start;  // upright in the world's axes
  start.angular_velocity = {1, 2, 3};
  problem.bodies = {body};
  problem.starts = {start};
  problem.forces.push_back({"uniform_gravity", {0}, {{"acceleration", Vector(-10, 0, 0)}}});  // up is +x: γ = e1
  const auto system = make_system<double>(problem, {});
  const BodySnapshot<double> s = system->snapshot(system->start().y, 0);
  EXPECT_DOUBLE_EQ(invariant("p_phi").value(problem, s), 2);  // 2·1 about x
  EXPECT_DOUBLE_EQ(invariant("p_psi").value(problem, s), 3);  // 1·3
  EXPECT_DOUBLE_EQ(invariant("casimir").value(problem, s), std::sqrt(4 + 16 + 9));
  EXPECT_DOUBLE_EQ(invariant("kovalevskaya").value(problem, s), (1 - 4 - 5) * (1 - 4 - 5) + 16);  // k = 1·10·0.5/1
}

/// The size of the terms, not of their sum: no value is larger, and it is zero only where nothing turns and no weight
/// pulls.
TEST(Invariants, ScalesAreTheSizeOfTheTerms) {
  for (const bool gravity : {false, true}) {
    for (const Vector& spin : {Vector(0, 0, 0), Vector(1, 0, 0), Vector(1e-20, 0, 1), Vector(0.3, -2, 0.7)}) {
      Problem problem;
      Body body;
      body.inertia = Vector(2, 2, 1).asDiagonal();
      body.pinned = true;
      body.center_of_mass = {0.5, 0, 0};
      BodyStart start;
      start.angular_velocity = spin;
      problem.bodies = {body};
      problem.starts = {start};
      if (gravity) problem.forces.push_back({"uniform_gravity", {0}, {{"acceleration", Vector(0, 0, -10)}}});
      const auto system = make_system<double>(problem, {});
      const BodySnapshot<double> s = system->snapshot(system->start().y, 0);
      for (const InvariantKind& kind : invariant_catalogue()) {
        const double scale = kind.scale(problem, s);
        EXPECT_LE(std::abs(kind.value(problem, s)), scale * (1 + 1e-12)) << kind.name;
        const bool weighs = gravity && kind.name == "kovalevskaya";
        EXPECT_EQ(scale > 0, !spin.isZero(0) || weighs) << kind.name;
      }
    }
  }
}

TEST(Invariants, LanesHaveTheDigitsOfEachProblem) {
  std::mt19937 random(7);
  std::vector<Problem> problems;
  for (int i = 0; i < lane_count; ++i) {
    Top top{.moments = Vector(2, 2, 1) * (1 + 0.3 * i), .center = Vector(0.5 - 0.1 * i, 0, 0)};
    top.gravity = random_vector(random);
    problems.push_back(problem_of(top, random));
  }
  std::vector<BodySnapshot<double>> each(problems.size());
  BodyMotion<Lanes> together;
  Vector3<Lanes> momentum;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    each[i].rotation = rotation_matrix(random_orientation(random));
    each[i].angular_velocity = random_vector(random);
    each[i].angular_momentum = random_vector(random);
    const int lane = static_cast<int>(i);
    for (int j = 0; j < 9; ++j) together.rotation.data()[j].set(lane, each[i].rotation.data()[j]);
    for (int j = 0; j < 3; ++j) together.angular_velocity[j].set(lane, each[i].angular_velocity[j]);
    for (int j = 0; j < 3; ++j) momentum[j].set(lane, each[i].angular_momentum[j]);
  }
  for (const InvariantKind& kind : invariant_catalogue()) {
    const Lanes values = kind.in_lanes(problems)(together, momentum);
    for (std::size_t i = 0; i < problems.size(); ++i)
      EXPECT_EQ(values[static_cast<int>(i)], kind.value(problems[i], each[i])) << kind.name << " in lane " << i;
  }
}

TEST(Invariants, NamesAreFound) {
  for (const InvariantKind& kind : invariant_catalogue()) {
    EXPECT_EQ(find_invariant(kind.name), &kind);
    EXPECT_FALSE(kind.unit.empty());
    EXPECT_FALSE(kind.summary.empty());
  }
  EXPECT_EQ(find_invariant("p_chi"), nullptr);
}

}  // namespace
}  // namespace polhode::invariants_test
