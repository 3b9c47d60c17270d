// SPDX-License-Identifier: BSD-3-Clause
// Slides that end within a step, and surfaces that pass each other closely or dip into each other within one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/shapes/box.hpp"
#include "collision/shapes/sphere.hpp"
#include "tests/collision/contact/contact_run.hpp"

namespace polhode::transition_test {
namespace {

using Vector = Vector3<double>;
constexpr double g = 9.81;

// v = (5 v0 + 2 R ω0)/7 from t = 2 |v0 − R ω0|/(7 μ g).
TEST(SlipToRoll, TheTransitionIsLocatedWithinALargeStep) {
  const double radius = 0.2, friction = 0.25;
  for (const std::string method : {"rk4", "semi_implicit_euler", "lie_midpoint", "odeint_dopri5", "cvode_adams"}) {
    for (const double h : {0.01, 0.037}) {
      for (const double spin : {0.0, 5.0, -8.0, 40.0}) {
        const double v0 = 3, slip = v0 - radius * spin;
        const double when = 2 * std::abs(slip) / (7 * friction * g), speed = v0 - 2 * slip / 7;
        ContactRun run;
        const BodyStart start{.position = {0, 0, radius}, .velocity = {v0, 0, 0}, .angular_velocity = {0, spin, 0}};
        run.add(1.5, std::make_shared<Sphere>(radius), start, 0, friction);
        run.add_floor(0, friction);
        run.add_gravity();
        run.method = method;
        run.dt = h;
        run.t_end = 1.2;
        run.run();
        ASSERT_EQ(run.transitions.size(), 1u) << method << " " << h << " " << spin;
        EXPECT_NEAR(run.transitions[0].t, when, 1e-8) << method << " " << h << " " << spin;
        EXPECT_EQ(run.transitions[0].b, 1u);
        const double slid = method == "semi_implicit_euler" ? h * std::abs(v0 - speed) : 1e-7;
        EXPECT_NEAR(run.transitions[0].point[0], 0.5 * (v0 + speed) * when, slid) << method;
        EXPECT_NEAR(run.path.back().velocity[0], speed, 1e-8) << method;
        EXPECT_NEAR(radius * run.path.back().angular_velocity[1], speed, 1e-8) << method;
        const double gone = 0.5 * (v0 + speed) * when + speed * (1.2 - when);
        EXPECT_NEAR(run.path.back().position[0], gone, slid) << method;
      }
    }
  }
}

// Up an incline: it stops after v0/(g (sin + μ cos)), and then sticks, or slides down.
TEST(Incline, ABlockThatSlidesUpIsSeenToStop) {
  const double angle = 0.3, v0 = 2.5;
  const Vector normal(std::sin(angle), 0, std::cos(angle)), down(std::cos(angle), 0, -std::sin(angle));
  for (const char* response : {"sequential_impulses", "simultaneous"}) {
    for (const double friction : {0.2, 0.4}) {
      ContactRun run;
      BodyStart start{.position = 0.25 * normal, .velocity = -v0 * down};
      start.orientation = {std::cos(angle / 2), 0, std::sin(angle / 2), 0};
      run.add(2, std::make_shared<Box>(Vector(0.5, 0.5, 0.25)), start, 0, friction);
      run.add_floor(0, friction, normal);
      run.add_gravity();
      run.response = response;
      run.dt = 0.01;
      run.run();
      const double up = g * (std::sin(angle) + friction * std::cos(angle)), when = v0 / up;
      const double back = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
      ASSERT_EQ(run.transitions.size(), 1u) << response;
      EXPECT_NEAR(run.transitions[0].t, when, 1e-5) << response;
      EXPECT_NEAR(run.path.back().velocity.dot(down), back * (1 - when), 1e-5) << response;
      const double gone = -0.5 * v0 * when + 0.5 * back * (1 - when) * (1 - when);
      EXPECT_NEAR((run.path.back().position - start.position).dot(down), gone, 1e-5) << response;
    }
  }
}

// A block that spins as it slides: its points turn their slip, and the end converges with the step.
TEST(Slide, TheEndOfASpinningSlideConvergesWithTheStep) {
  const auto stop = [](double h) {
    ContactRun run;
    const BodyStart start{.position = {0, 0, 0.1}, .velocity = {1, 0.3, 0}, .angular_velocity = {0, 0, 6}};
    run.add(2, std::make_shared<Box>(Vector(0.5, 0.4, 0.1)), start, 0, 0.3);
    run.add_floor(0, 0.3);
    run.add_gravity();
    run.dt = h;
    run.t_end = 0.8;
    run.run();
    EXPECT_LT(run.path.back().velocity.norm(), 1e-9);
    return run.transitions.empty() ? 0.0 : run.transitions.back().t;
  };
  const double exact = stop(1e-4), coarse = std::abs(stop(4e-3) - exact), fine = std::abs(stop(5e-4) - exact);
  EXPECT_LT(fine, 0.3 * coarse);
  EXPECT_LT(coarse, 1e-3);
}

// Two free plates that attract each other, one sliding and spinning on the other, until they go together: held forces
// are equal, opposite and in line.
TEST(HeldContacts, KeepMomentumOfFreeBodies) {
  ContactRun run;
  const auto plate = std::make_shared<Box>(Vector(0.5, 0.4, 0.1));
  run.add(2, plate, {.position = {0, 0, 0.1}, .velocity = {0.5, 0.2, 0}, .angular_velocity = {0, 0, 2}}, 0, 0.3);
  run.add(3, plate, {.position = {0, 0, -0.1}, .velocity = {0, -0.3, 0}}, 0, 0.3);
  run.problem.forces.push_back({"point_gravity", {0, 1}, {{"gravitational_constant", 0.15}}});
  run.dt = 2e-3;
  run.t_end = 0.3;
  run.run();
  EXPECT_GE(run.transitions.size(), 1u);
  const Measurement<double>&first = run.samples.front().seen, &last = run.samples.back().seen;
  EXPECT_LT((last.linear_momentum - first.linear_momentum).norm(), 1e-13);
  EXPECT_LT((last.angular_momentum - first.angular_momentum).norm(), 1e-9);
}

// A body that skims past a surface, however fast, costs few evaluations: right-hand sides of its run over those without
// contact.
TEST(Skimming, CostsNextToNothing) {
  for (const double gap : {1e-4, 1e-7, 2e-9}) {
    for (const bool box : {false, true}) {
      ContactRun run;
      ShapePointer shape = std::make_shared<Sphere>(0.5);
      if (box) shape = std::make_shared<Box>(Vector(0.5, 0.5, 0.5));
      const double spin = box ? 5 : 0;
      run.add(1, shape, {.position = {0, 0, 0.5 + gap}, .velocity = {30, 0, 0}, .angular_velocity = {0, 0, spin}});
      run.add_floor();
      run.t_end = 0.1;
      run.run();
      EXPECT_EQ(run.impacts.size(), 0u);
      EXPECT_LE(run.outcome.evaluations, 20 * 100) << gap << " " << box;
    }
    ContactRun run;  // a run over a box that lies there, both turning
    const BodyStart ball{.position = {-0.4, 0, 0.5 + gap}, .velocity = {20, 0, 0}, .angular_velocity = {0, 40, 0}};
    run.add(1, std::make_shared<Sphere>(0.5), ball);
    run.add(1, std::make_shared<Box>(Vector(0.5, 0.5, 0.5)), {.position = {0, 0, -0.5}, .angular_velocity = {0, 0, 5}});
    run.narrow_phase = "gjk";
    run.t_end = 0.1;
    run.run();
    EXPECT_EQ(run.impacts.size(), 0u);
    EXPECT_LE(run.outcome.evaluations, 20 * 100) << gap;
  }
}

// A rod whose end is below the floor for a part of a step only.
TEST(Located, ADipWithinAStepIsFound) {
  const auto first_impact = [](double h, double spin) {
    ContactRun run;
    BodyStart start{.position = {0, 0, 0.4999}, .angular_velocity = {0, spin, 0}};
    start.orientation = {std::sqrt(0.5), 0, std::sqrt(0.5), 0};
    run.add(1, std::make_shared<Box>(Vector(0.01, 0.01, 0.5)), start, 1);
    run.add_floor();
    run.dt = h;
    run.t_end = 0.08;
    run.run();
    return run.impacts.empty() ? 0 : run.impacts.front().t;
  };
  for (const double spin : {60.0, 100.0, 155.0}) {
    const double fine = first_impact(1e-4, spin);
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(first_impact(0.02, spin), fine, 2e-2 * fine)
        << spin;  // RK4 turns a rod by three radians a step so well
  }
}

}  // namespace
}  // namespace polhode::transition_test
