// SPDX-License-Identifier: BSD-3-Clause
// Tests which problems are recognised as having an exact motion, and that it is the motion. Each is compared with a
// reference in extended precision that uses no part of it and proves its digits (core/exact/reference_motion.hpp).
#include "core/exact/exact_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/exact/reference_motion.hpp"
#include "core/forces/catalogue.hpp"

namespace polhode::exact_motion_test {
namespace {

using Vector = Vector3<double>;
using Values = std::map<std::string, ParameterValue>;

/// A force with the defaults of its kind filled in.
ForceParameters force(const std::string& kind, std::vector<std::size_t> bodies, const Values& given) {
  ForceParameters f{kind, std::move(bodies), {}};
  for (const Parameter& p : find_force(kind)->kind.parameters) f.values[p.key] = p.value;
  for (const auto& [key, value] : given) f.values.at(key) = value;
  return f;
}
ForceParameters gravity(std::vector<std::size_t> bodies = {0}) {
  return force("uniform_gravity", std::move(bodies), {{"acceleration", Vector(0, 0, -9.81)}});
}

Body body(const Vector& moments, double mass = 2) {
  Body b;
  b.mass = mass;
  b.inertia = moments.asDiagonal();
  return b;
}
BodyStart aslant() {
  BodyStart s;
  s.position = {0.3, -1, 0.5};
  s.orientation = {0.5, -0.1, 0.7, 0.5};
  s.velocity = {1, 0.4, -0.3};
  s.angular_velocity = {0.4, 2, -1};
  return s;
}

struct Case {
  std::string name;
  Problem problem;
  bool position, attitude, angular_velocity;
};

std::vector<Case> cases() {
  const Vector box(0.6, 0.8, 1.0), ball(0.5, 0.5, 0.5);
  const auto one = [](const Body& b, const BodyStart& s, std::vector<ForceParameters> forces) {
    return Problem{{b}, {s}, std::move(forces)};
  };
  const auto spring = [](double k, const Values& more = {}) {
    Values v = {{"stiffness", k}, {"anchor_world", Vector(0.2, 0.1, 2)}};
    for (const auto& [key, value] : more) v[key] = value;
    return force("spring", {0}, v);
  };
  std::vector<Case> all;
  all.push_back({"projectile",
                 one(body(box), aslant(), {gravity(), force("constant_force", {0}, {{"force", Vector(1, 2, 0)}})}),
                 true, true, true});
  all.push_back({"tumbling on a spring", one(body(box), aslant(), {gravity(), spring(30.0)}), true, true, true});
  all.push_back({"two springs, drag and a damper",
                 one(body(box), aslant(),
                     {spring(3.0), spring(5.0), gravity(), force("drag", {0}, {{"linear", 0.7}}),
                      force("damper", {0}, {{"damping", 0.2}})}),
                 true, true, true});
  all.push_back({"overdamped", one(body(box), aslant(), {spring(3.0), force("drag", {0}, {{"linear", 30.0}})}), true,
                 true, true});
  all.push_back({"falling with drag", one(body(box), aslant(), {gravity(), force("drag", {0}, {{"linear", 1.3}})}),
                 true, true, true});
  all.push_back({"spring with a rest length", one(body(box), aslant(), {spring(3.0, {{"rest_length", 0.5}})}), false,
                 true, true});
  all.push_back(
      {"damping along the spring", one(body(box), aslant(), {spring(3.0, {{"damping", 0.5}})}), false, true, true});
  all.push_back({"spring at a corner", one(body(box), aslant(), {spring(3.0, {{"anchor_body", Vector(0.1, 0, 0)}})}),
                 false, false, false});
  all.push_back(
      {"quadratic drag", one(body(box), aslant(), {force("drag", {0}, {{"quadratic", 0.5}})}), false, true, true});

  BodyStart about_x = aslant();
  about_x.angular_velocity = {3, 0, 0};
  about_x.angular_velocity_in_body = true;
  const auto torque = [](const Vector& t, const std::string& frame) {
    return force("constant_torque", {0}, {{"torque", t}, {"frame", frame}});
  };
  all.push_back({"axial torque in the body", one(body(box), about_x, {torque({0.4, 0, 0}, "body")}), true, true, true});
  all.push_back(
      {"axial torque against drag",
       one(body(box), about_x, {torque({0.4, 0, 0}, "body"), force("drag", {0}, {{"angular", 0.3}, {"linear", 0.2}})}),
       true, true, true});
  all.push_back({"torque on a symmetric body, in the world",
                 one(body({0.3, 0.3, 0.1}), {{}, identity_quaternion<double>(), {}, {0, 0, 4}, false},
                     {torque({0, 0, -0.2}, "world")}),
                 true, true, true});
  all.push_back({"torque across the axis", one(body(box), about_x, {torque({0, 0.4, 0}, "body")}), true, false, false});
  all.push_back(
      {"sphere from rest",
       one(body(ball), {{}, {0.5, -0.1, 0.7, 0.5}, {}, Vector::Zero(), false}, {torque({0.1, 0.2, -0.2}, "world")}),
       true, true, true});
  all.push_back(
      {"sphere slowed down", one(body(ball), aslant(), {force("drag", {0}, {{"angular", 0.3}})}), true, true, true});
  all.push_back({"sphere turned aside",
                 one(body(ball), aslant(), {torque({0.3, 0.2, -0.2}, "world"), force("drag", {0}, {{"angular", 0.1}})}),
                 true, false, true});

  Body top = body({0.3, 0.3, 0.1}, 1);
  top.pinned = true;
  top.center_of_mass = {0, 0, 0.5};
  all.push_back({"Lagrange's top", one(top, aslant(), {gravity()}), false, true, true});
  top.inertia = Vector(0.3, 0.29, 0.1).asDiagonal();
  all.push_back({"another top", one(top, aslant(), {gravity()}), false, false, false});
  all.push_back({"pendulum", one(top, {{}, {0.8, 0.6, 0, 0}, {}, {-1, 0, 0}, false}, {gravity()}), false, true, true});
  all.push_back(
      {"spun by a force at a point",
       one(body({0.3, 0.3, 0.1}), aslant(),
           {force("constant_force", {0}, {{"force", Vector(0, 1, 3)}, {"anchor_body", Vector(0, 0, 0.2)}}), gravity()}),
       true, true, true});

  const auto pair = [&](const Vector& v, std::vector<ForceParameters> more) {
    BodyStart left = aslant(), right = aslant();
    right.position += Vector(1, 0.3, 0);
    right.velocity += v;
    more.push_back(force("point_gravity", {0, 1}, {{"gravitational_constant", 0.7}}));
    return Problem{{body(box, 1), body(ball, 2)}, {left, right}, std::move(more)};
  };
  all.push_back({"Kepler pair", pair({0, 1, 0.3}, {}), true, true, true});
  all.push_back({"hyperbola in free fall", pair({0, 4, 0.3}, {gravity({0, 1})}), true, true, true});
  all.push_back({"one of them falls", pair({0, 1, 0.3}, {gravity({0})}), false, true, true});
  Problem sun = pair({0, 0, 0}, {});
  sun.bodies[1].fixed = true;
  sun.bodies[1].mass = 5;
  sun.starts[0].velocity = {-0.5, 1.5, 0.6};
  all.push_back({"round a static body", sun, true, true, true});
  return all;
}

TEST(ExactMotion, KnowsWhatItKnows) {
  for (const Case& c : cases()) {
    const ExactMotion exact(*make_system<double>(c.problem, {}));
    EXPECT_EQ(exact.has_position(), c.position) << c.name;
    EXPECT_EQ(exact.has_attitude(), c.attitude) << c.name;
    EXPECT_EQ(exact.has_angular_velocity(), c.angular_velocity) << c.name;
  }
}

// The exact motion is that of the reference wherever both are: to 1e-13 of sizes and rates near 1, after 6 s.
TEST(ExactMotion, IsTheReference) {
  for (const Case& c : cases()) {
    const auto reference = std::make_shared<const ReferenceMotion>(c.problem, true, 6.0);
    ASSERT_LE(reference->uncertainty().largest(), 1e-14) << c.name;
    ReferenceMotion::Follower follower(reference);
    const auto system = make_system<double>(c.problem, {});
    const ExactMotion exact(*system);
    for (const double t : {0.0, 0.05, 1.0, 1.7, 6.0}) {
      State<double> state = system->start();
      state.t = t;
      for (std::size_t i = 0; i < system->moving(); ++i) {
        const Layout::Slot slot = system->layout().slots[i];
        const ExactMotion::BodyAt at = exact.at(t, i);
        if (at.path && slot.position >= 0) {
          state.y.segment<3>(slot.position) = at.path->position;
          state.y.segment<3>(slot.velocity) = at.path->velocity;
        }
        if (at.rotation) {
          if (at.rotation->orientation) state.y.segment<4>(slot.orientation) = *at.rotation->orientation;
          state.y.segment<3>(slot.angular) = at.rotation->angular_velocity;
        }
      }
      const ExactMotion::Error error = follower.error(*system, state);
      EXPECT_LE(c.position ? *error.position : 0, 1e-13) << c.name << " at t = " << t;
      EXPECT_LE(c.attitude ? *error.attitude : 0, 1e-13) << c.name << " at t = " << t;
      EXPECT_LE(c.angular_velocity ? *error.angular_velocity : 0, 1e-13) << c.name << " at t = " << t;
      const ExactMotion::Error self = exact.error(*system, state);
      EXPECT_LE(self.position.value_or(0) + self.attitude.value_or(0) + self.angular_velocity.value_or(0), 1e-14);
    }
  }
}

// Tops from anywhere, also upright, hanging, at rest and with components that vanish.
TEST(ExactMotion, HeavyTopsFromAnywhere) {
  std::mt19937 dice(7);
  std::normal_distribution<double> normal;
  const std::vector<Quaternion<double>> turns = {{1, 0, 0, 0},     {0, 1, 0, 0},      {0, 0, 1, 0},    {0, 0, 0, 1},
                                                 {0.8, 0.6, 0, 0}, {0.6, 0, 0, -0.8}, {0, 0.6, 0, 0.8}};
  const std::vector<double> speeds = {0, 0, 1e-9, -1e-4, 3, -11};
  for (int k = 0; k < 80; ++k) {
    Body top = body({0.3, 0.3, k % 3 == 0 ? 0.55 : 0.1}, 1);
    top.pinned = true;
    top.center_of_mass = {0, 0, k % 2 == 0 ? 0.5 : -0.2};
    BodyStart start;
    const std::size_t turn = dice() % (turns.size() + 3);
    start.orientation = turn < turns.size()
                            ? turns[turn]
                            : Quaternion<double>(normal(dice), normal(dice), normal(dice), normal(dice)).normalized();
    start.angular_velocity_in_body = true;
    for (int i = 0; i < 3; ++i) start.angular_velocity[i] = k < 60 ? speeds[dice() % speeds.size()] : 4 * normal(dice);
    const Problem problem{{top}, {start}, {gravity()}};
    const auto system = make_system<double>(problem, {});
    const ExactMotion exact(*system);
    const auto reference = std::make_shared<const ReferenceMotion>(problem, true, 3.0);
    ReferenceMotion::Follower follower(reference);
    for (const double t : {0.0, 0.3, 3.0}) {
      State<double> state = system->start();
      state.t = t;
      const RotationAt at = *exact.at(t, 0).rotation;
      state.y.segment<4>(0) = *at.orientation;
      state.y.segment<3>(4) = at.angular_velocity;
      const ExactMotion::Error error = follower.error(*system, state);
      const double allowed =
          1e-14 * (1 + (start.angular_velocity.norm() + 7) * t) + 2 * reference->uncertainty().largest();
      const auto what = ::testing::Message() << "top " << k << ", q = " << start.orientation.transpose()
                                             << ", w = " << start.angular_velocity.transpose() << ", t = " << t;
      EXPECT_LE(*error.attitude, allowed) << what;
      const double speed = start.angular_velocity.norm();
      EXPECT_LE(*error.angular_velocity * (speed > 0 ? speed : 1), 10 * allowed) << what;
    }
  }
}

TEST(ReferenceMotion, SaysThatItCannotProveAChaoticMotion) {
  // a box on an off-centre spring, far beyond its linear range
  Problem chaos = cases()[0].problem;
  chaos.forces = {
      gravity(),
      force("spring", {0}, {{"stiffness", 60.0}, {"rest_length", 1.0}, {"anchor_body", Vector(0.3, 0.2, 0.4)}})};
  EXPECT_GE(ReferenceMotion(chaos, true, 400.0).uncertainty().largest(), 1e-3);
  EXPECT_LE(ReferenceMotion(chaos, true, 5.0).uncertainty().largest(), 1e-13);
}

TEST(ReferenceMotion, LeavesTheGyroscopicTermOut) {
  Problem top = cases()[0].problem;
  top.forces.clear();
  const auto system = make_system<double>(top, {});
  ReferenceMotion::Follower with(std::make_shared<const ReferenceMotion>(top, true, 2.0)),
      without(std::make_shared<const ReferenceMotion>(top, false, 2.0));
  State<double> state = system->start();
  state.t = 2;
  state.y.segment<3>(system->layout().slots[0].angular) = ExactMotion(*system).at(2, 0).rotation->angular_velocity;
  EXPECT_LE(*with.error(*system, state).angular_velocity, 1e-14);
  EXPECT_GE(*without.error(*system, state).angular_velocity, 1e-3);
}

}  // namespace
}  // namespace polhode::exact_motion_test
