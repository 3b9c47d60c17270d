// SPDX-License-Identifier: BSD-3-Clause
// The response that is a force, through impacts and at rest, against closed forms.
#include "collision/contact/compliant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/shapes/box.hpp"
#include "collision/shapes/sphere.hpp"
#include "tests/collision/contact/contact_run.hpp"

namespace polhode::compliant_test {
namespace {

using Vector = Vector3<double>;
constexpr double g = 9.81, pi = std::numbers::pi;
constexpr double radius = 0.1, mass = 2, stiffness = 5e4;

/// A ball at a height over its rest on the floor, with a velocity up.
ContactRun ball(double above, double speed, double restitution = 1) {
  ContactRun run;
  run.response = "compliant";
  run.compliance.stiffness = stiffness;
  run.add(mass, std::make_shared<Sphere>(radius), {.position = {0, 0, radius + above}, .velocity = {0, 0, speed}},
          restitution);
  run.add_floor();
  return run;
}

double restitution_of(double ratio) {
  return ratio < 1 ? std::exp(-2 * ratio * std::acos(ratio) / std::sqrt(1 - ratio * ratio)) : std::exp(-2.0);
}

TEST(DampingRatio, IsThatOfTheRestitution) {
  EXPECT_EQ(damping_ratio(1), 0);
  for (double e = 0.14; e < 1; e += 0.01) EXPECT_NEAR(restitution_of(damping_ratio(e)), e, 1e-12);
  for (const double e : {0.0, 0.1, 0.135}) EXPECT_NEAR(damping_ratio(e), 1, 1e-12);
}

TEST(Compliant, AnElasticImpactLastsHalfAPeriod) {
  for (const double given : {stiffness, 0.0}) {
    ContactRun run = ball(0, -0.3);
    run.compliance.stiffness = given;
    run.t_end = given > 0 ? pi * std::sqrt(mass / given) : 5e-3;
    run.dt = run.t_end / 400;
    run.run();
    EXPECT_NEAR(run.path.back().position[2], radius, 1e-11);
    EXPECT_NEAR(run.path.back().velocity[2], 0.3, 1e-9);
    const double rate = pi / run.t_end;
    for (std::size_t k = 0; k < run.path.size(); ++k) {
      ASSERT_NEAR(radius - run.path[k].position[2], 0.3 / rate * std::sin(rate * run.samples[k].t), 1e-11);
    }
  }
}

// About the depth at which it would rest, m g/k, without leaving the floor.
TEST(Compliant, AVibrationHasTheOrderOfTheMethod) {
  const double rate = std::sqrt(stiffness / mass), sag = mass * g / stiffness, amplitude = 0.9 * sag;
  const auto error = [&](int steps) {
    ContactRun run = ball(amplitude - sag, 0);
    run.add_gravity(g);
    run.t_end = 10.3 / rate;
    run.dt = run.t_end / steps;
    run.run();
    return std::abs(run.path.back().position[2] - radius + sag - amplitude * std::cos(10.3)) / amplitude;
  };
  EXPECT_NEAR(std::log2(error(80) / error(160)), 4, 0.15);
  EXPECT_LT(error(1280), 1e-8);
}

// The kink where the surfaces meet leaves order 2, the jump of the damper order 1.
TEST(Compliant, FixedStepsAcrossTheImpactKeepTheStatedOrder) {
  for (const double e : {1.0, 0.5}) {
    const auto error = [&](double h) {  // the largest of impacts at different places within a step
      double most = 0;
      for (int k = 0; k < 16; ++k) {
        ContactRun run = ball(0.01 + k / 16.0 * h, -1, e);
        run.t_end = 0.08;
        run.dt = h;
        run.run();
        most = std::max(most, std::abs(run.path.back().velocity[2] - e));
      }
      return most;
    };
    EXPECT_NEAR(std::log2(error(4e-4) / error(2.5e-5)) / 4, e == 1 ? 2 : 1, 0.3) << e;
  }
}

TEST(Compliant, ABallReboundsWithTheRestitutionOfThePair) {
  for (const double e : {1.0, 0.9, 0.5, 0.2, 0.0}) {
    for (const double speed : {0.01, 1.0, 20.0}) {
      for (const char* method : {"cvode_bdf", "cvode_adams", "arkode_erk", "odeint_dopri5"}) {
        ContactRun run = ball(0.01 * speed, -speed, e);
        run.method = method;
        run.tolerance = 1e-11;
        run.t_end = 0.05;
        run.run();
        EXPECT_NEAR(run.path.back().velocity[2] / speed, std::max(e, std::exp(-2.0)), 1e-6) << method << " " << speed;
        EXPECT_NEAR(run.samples.back().work,
                    0.5 * mass * speed * speed * (std::pow(std::max(e, std::exp(-2.0)), 2) - 1), 1e-5 * speed * speed)
            << method;
      }
    }
  }
}

TEST(Compliant, TwoBallsExchangeMomentum) {
  for (const double e : {1.0, 0.6}) {
    ContactRun run;
    run.response = "compliant";
    run.add(1, std::make_shared<Sphere>(0.1), {.position = {0, 0, 0}, .velocity = {1, 0, 0}}, e);
    run.add(3, std::make_shared<Sphere>(0.2), {.position = {0.31, 0, 0}}, 0);
    run.method = "cvode_adams";
    run.t_end = 0.1;
    run.run();
    EXPECT_NEAR(run.path.back().velocity[0], 1 - 0.75 * (1 + e), 1e-6);
    EXPECT_NEAR(run.samples.back().seen.linear_momentum[0], 1, 1e-9);
  }
}

ContactRun two_boxes(double restitution, double friction) {
  ContactRun run;
  run.response = "compliant";
  const auto box = std::make_shared<Box>(Vector(0.2, 0.3, 0.4));
  run.add(1, box, {.position = {0, 0, 0}, .velocity = {1, 0.2, 0}, .angular_velocity = {2, -1, 3}}, restitution,
          friction);
  run.add(2, box, {.position = {0.6, 0.1, 0.1}, .velocity = {-1, 0, 0}, .angular_velocity = {-1, 4, 0}}, restitution,
          friction);
  return run;
}

TEST(Compliant, BoxesKeepMomentumAndTheLedger) {
  for (const double e : {1.0, 0.3}) {
    for (const double friction : {0.0, 0.5}) {
      ContactRun run = two_boxes(e, friction);
      run.method = "odeint_dopri5";
      run.t_end = 0.5;
      run.run();
      const Sample &first = run.samples.front(), &last = run.samples.back();
      EXPECT_LT((last.seen.linear_momentum - first.seen.linear_momentum).norm(), 1e-12);
      EXPECT_LT((last.seen.angular_momentum - first.seen.angular_momentum).norm(), 1e-7);
      EXPECT_GT((run.path.back().velocity - run.path.front().velocity).norm(), 0.5);  // they met
      for (const Sample& s : run.samples) ASSERT_NEAR(s.ledger(0), first.ledger(0), 1e-7) << s.t;
      EXPECT_LT(last.seen.energy(), first.seen.energy() + 1e-7);
      if (e < 1) {
        EXPECT_LT(last.seen.energy(), 0.95 * first.seen.energy());
      }
    }
  }
}

ContactRun tumbling_cube(double restitution, double friction) {
  ContactRun run;
  run.response = "compliant";
  run.add(1, std::make_shared<Box>(Vector(0.5, 0.5, 0.5)), {.position = {0, 0, 0.6}, .angular_velocity = {1, 2, 0.5}},
          restitution, friction);
  run.add_floor(0, friction);
  run.add_gravity();
  return run;
}

TEST(Compliant, AnElasticCubeKeepsItsEnergyToTheOrderLeft) {
  const auto drift = [](const char* method, double h) {
    ContactRun run = tumbling_cube(1, 0);
    run.method = method;
    run.dt = h;
    run.t_end = 1.5;
    run.run();
    double most = 0;
    for (const Sample& s : run.samples) most = std::max(most, std::abs(s.seen.energy() - run.samples[0].seen.energy()));
    EXPECT_EQ(run.samples.back().work, 0);
    return most;
  };
  const double coarse = drift("rk4", 4e-4), fine = drift("rk4", 2e-5);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, coarse / 100);
  EXPECT_LT(drift("cvode_bdf", 0), 1e-5);
  EXPECT_LT(drift("odeint_dopri5", 0), 1e-6);
}

TEST(Compliant, DamperAndFrictionOnlyTake) {
  ContactRun run = tumbling_cube(0.4, 0.5);
  run.method = "odeint_dopri5";
  run.t_end = 2;
  run.run();
  for (std::size_t k = 1; k < run.samples.size(); ++k) {
    const Sample &before = run.samples[k - 1], &now = run.samples[k];
    ASSERT_LE(now.work, before.work + 1e-12) << now.t;
    ASSERT_LE(now.seen.energy(), before.seen.energy() + 1e-7) << now.t;
    ASSERT_NEAR(now.ledger(0), run.samples[0].ledger(0), 1e-6) << now.t;
  }
  EXPECT_LT(run.samples.back().seen.kinetic, 1e-2);  // it has come to rest
}

// Under a share q of what friction can bear a block creeps by s q/√(1 − q²); beyond, it slides.
TEST(Compliant, ABlockOnAnInclineCreepsAsItMust) {
  const double angle = 0.3, share = std::tan(angle) / 0.5, slip_speed = 1e-4;
  ContactRun run;
  const Vector normal(std::sin(angle), 0, std::cos(angle)), down(std::cos(angle), 0, -std::sin(angle));
  BodyStart start{.position = 0.25 * normal};
  start.orientation = {std::cos(angle / 2), 0, std::sin(angle / 2), 0};
  run.response = "compliant";
  run.method = "cvode_bdf";
  run.compliance.slip_speed = slip_speed;
  run.add(2, std::make_shared<Box>(Vector(0.5, 0.5, 0.25)), start, 0, 0.5);
  run.add_floor(0, 0.5, normal);
  run.add_gravity();
  run.t_end = 2;
  run.run();
  const double creep = slip_speed * share / std::sqrt(1 - share * share);
  EXPECT_NEAR(run.path.back().velocity.dot(down), creep, 1e-6 * creep);
  EXPECT_NEAR((run.path.back().position - start.position).dot(down), 2 * creep, 0.01 * creep);
  const double depth = 2 * g * std::cos(angle) / (4 * 2 * std::pow(pi / 5e-3, 2));  // depth on four springs
  EXPECT_NEAR((run.path.back().position - start.position).dot(normal), -depth, 1e-3 * depth);
}

// A rod that swings about a pivot and knocks on the floor.
TEST(Compliant, APinnedBodyKeepsItsEnergyToo) {
  ContactRun run;
  run.response = "compliant";
  run.method = "odeint_dopri5";
  run.add(2, std::make_shared<Box>(Vector(0.5, 0.05, 0.05)), {.position = {0, 0, 0.3}}, 1);
  Body& rod = run.problem.bodies[0];
  rod.pinned = true;
  rod.center_of_mass = {0.4, 0, 0};
  rod.inertia += rod.mass * 0.16 * Vector(0, 1, 1).asDiagonal().toDenseMatrix();
  run.add_floor();
  run.add_gravity();
  run.t_end = 2;
  run.run();
  bool up = false;
  for (std::size_t k = 0; k < run.samples.size(); ++k) {
    ASSERT_NEAR(run.samples[k].seen.energy(), run.samples[0].seen.energy(), 1e-6) << run.samples[k].t;
    ASSERT_GT(run.path[k].position[2], 0.05);  // the mass centre of a rod whose end is on the floor
    up = up || (run.samples[k].t > 1 && run.path[k].position[2] > 0.29);
  }
  EXPECT_TRUE(up);
}

TEST(Compliant, DegenerateStartsGiveNumbers) {
  for (const char* narrow : {"sat", "gjk"}) {
    for (const double apart : {0.0, 1e-12, 0.3}) {
      ContactRun run;
      run.response = "compliant";
      run.narrow_phase = narrow;
      run.dt = 1e-4;
      run.t_end = 0.1;
      const auto cube = std::make_shared<Box>(Vector(0.5, 0.5, 0.5));
      for (const double x : {0.0, apart}) run.add(1, cube, {.position = {x, 0, 0}}, 0, 0.5);
      run.run();
      ASSERT_TRUE(run.end.y.allFinite());
      // No faster than springs as deep as the cubes are: √(n k/m') d.
      EXPECT_LT(run.path.back().velocity.norm(), 0.5 * std::sqrt(8) * pi / 5e-3);
    }
  }
}

}  // namespace
}  // namespace polhode::compliant_test
