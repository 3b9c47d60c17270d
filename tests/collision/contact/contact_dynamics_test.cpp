// SPDX-License-Identifier: BSD-3-Clause
// Bodies that bounce, rest, slide and roll, against closed forms and published figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/shapes/box.hpp"
#include "collision/shapes/sphere.hpp"
#include "tests/collision/contact/contact_run.hpp"

namespace polhode::contact_dynamics_test {
namespace {

using Vector = Vector3<double>;
constexpr double g = 9.81;

ContactRun bouncing_ball(double restitution) {
  ContactRun run;
  run.add(10, std::make_shared<Sphere>(0.1), {.position = {0, 0, 5}}, restitution);
  run.add_floor();
  run.add_gravity();
  return run;
}

struct LocatedBy {
  const char* method;
  double accuracy;      // s
  std::size_t bounces;  // number of bounces that rise well above the method's own error
  double at_the_end;    // effect of that error on the lowest bounces, s and m
};
class BouncingBall : public testing::TestWithParam<LocatedBy> {};

// t1 = √(2h/g), t_{n+1} − t_n = 2 eⁿ t1, Zeno time t1 (1 + e)/(1 − e), apexes h e^{2n}.
TEST_P(BouncingBall, KeepsTheTimesAndRestsWhereTheyEnd) {
  for (const double e : {0.5, 0.8}) {
    ContactRun run = bouncing_ball(e);
    run.method = GetParam().method;
    run.tolerance = 1e-13;
    const double accuracy = GetParam().accuracy;
    const double first = std::sqrt(2 * 4.9 / g), zeno = first * (1 + e) / (1 - e);
    run.t_end = zeno + 0.25;
    run.run();
    ASSERT_GE(run.impacts.size(), GetParam().bounces);
    double t = first, speed = std::sqrt(2 * g * 4.9);
    for (std::size_t k = 0; k < GetParam().bounces; ++k) {
      EXPECT_NEAR(run.impacts[k].t, t, accuracy) << k;
      EXPECT_NEAR(run.impacts[k].impulse[2], 10 * (1 + e) * speed, 10 * 100 * accuracy) << k;
      speed *= e;
      t += 2 * speed / g;
    }
    const auto last = std::find_if(run.impacts.begin(), run.impacts.end(),
                                   [](const Impact& i) { return std::isfinite(i.rests_from); });
    // A method whose error is higher than the lowest bounces ends where it cannot tell them from rest.
    ASSERT_TRUE(last != run.impacts.end() || GetParam().at_the_end > 1e-9);
    EXPECT_NEAR(last != run.impacts.end() ? last->rests_from : run.impacts.back().t, zeno, GetParam().at_the_end);
    for (std::size_t k = 0; k < run.path.size(); ++k) {
      if (run.samples[k].t < zeno) continue;
      ASSERT_NEAR(run.path[k].position[2], 0.1, GetParam().at_the_end) << run.samples[k].t;
      ASSERT_NEAR(run.path[k].velocity[2], 0, GetParam().at_the_end) << run.samples[k].t;
    }
    EXPECT_NEAR(run.losses.impact, 10 * g * 4.9, 500 * GetParam().at_the_end);
    EXPECT_EQ(run.losses.friction, 0);
    EXPECT_EQ(run.losses.penetration, 0);
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, BouncingBall,
                         testing::Values(LocatedBy{"rk4", 1e-10, 20, 1e-9}, LocatedBy{"lie_midpoint", 1e-10, 20, 1e-9},
                                         LocatedBy{"odeint_dopri5", 1e-9, 20, 1e-9},
                                         LocatedBy{"cvode_adams", 1e-8, 10, 1e-5},
                                         LocatedBy{"cvode_bdf", 2e-8, 10, 1e-5},
                                         LocatedBy{"arkode_erk", 1e-9, 12, 1e-6}),
                         [](const auto& param) { return std::string(param.param.method); });

TEST(ElasticBall, KeepsItsEnergyWhereImpactsAreLocated) {
  ContactRun run = bouncing_ball(1);
  run.t_end = 20;
  run.run();
  EXPECT_EQ(run.impacts.size(), 10u);
  for (const Sample& s : run.samples) ASSERT_NEAR(s.seen.energy() / 490.5, 1, 1e-9) << s.t;
}

// SimBenchmark, "bouncing": the mean over 49 equal balls of (ΣE − 24034.5)², J². REFERENCE_RESULTS 1.3.
double mean_squared_energy_error(Timing timing, double h) {
  ContactRun run = bouncing_ball(1);
  run.method = "semi_implicit_euler";
  run.response = "single_impulse";
  run.timing = timing;
  run.dt = h;
  run.t_end = 20;
  run.run();
  long double sum = 0;
  for (std::size_t k = 1; k < run.samples.size(); ++k) {
    const long double error = 49 * (run.samples[k].seen.energy() - 490.5);
    sum += error * error;
  }
  return double(sum / (run.samples.size() - 1));
}

TEST(SimBenchmarkBouncing, FiguresOfOde) {
  EXPECT_NEAR(mean_squared_energy_error(Timing::at_step, 1e-2) / 18808.3, 1, 1e-4);
  EXPECT_NEAR(mean_squared_energy_error(Timing::at_step, 1e-3) / 185.027, 1, 1e-4);
  EXPECT_NEAR(mean_squared_energy_error(Timing::at_step, 1e-4) / 1.85055, 1, 1e-4);
}
TEST(SimBenchmarkBouncing, FigureOfOdeAtTheSmallestStepSlow) {
  EXPECT_NEAR(mean_squared_energy_error(Timing::at_step, 1e-5) / 0.0185024, 1, 1e-4);
}
TEST(SimBenchmarkBouncing, FigureOfBulletByTheOtherOrder) {
  EXPECT_NEAR(mean_squared_energy_error(Timing::at_step_reflecting_free_end, 1e-3) / 75257, 1, 1e-4);
}
TEST(SimBenchmarkBouncing, LocatedImpactsLeaveTheErrorOfTheFlight) {
  EXPECT_NEAR(mean_squared_energy_error(Timing::located, 1e-4) / 741, 1, 1e-2);
}

ContactRun dropped_cube(double restitution, const Vector& spin) {
  ContactRun run;
  run.add(1, std::make_shared<Box>(Vector(0.5, 0.5, 0.5)), {.position = {0, 0, 1.9}, .angular_velocity = spin},
          restitution);
  run.add_floor();
  run.add_gravity();
  return run;
}

TEST(ElasticCube, LocatedKeepsTheEnergy) {
  for (const Vector& spin : {Vector(0, 0, 0), Vector(1, 2, 0.5), Vector(-3, 0.2, 4)}) {
    ContactRun run = dropped_cube(1, spin);
    run.t_end = 10;
    run.run();
    EXPECT_GE(run.impacts.size(), 8u);
    const double e0 = run.samples.front().seen.energy();
    for (const Sample& s : run.samples) ASSERT_LE(s.seen.energy() / e0, 1 + 1e-8) << s.t;
    for (const Sample& s : run.samples) ASSERT_GE(s.seen.energy() / e0, 1 - 1e-8) << s.t;
  }
}

// Semi-implicit Euler keeps E − ½ m g h v_z in flight, and the reflection of the velocity at the start of the step does
// too.
TEST(ElasticCube, TimeSteppingKeepsTheModifiedEnergy) {
  for (const Vector& spin : {Vector(0, 0, 0), Vector(1, 2, 0.5), Vector(-3, 0.2, 4)}) {
    double before = 1;
    for (const int rate : {240, 960, 3840}) {
      ContactRun run = dropped_cube(1, spin);
      run.method = "semi_implicit_euler";
      run.timing = Timing::at_step;
      run.dt = 1.0 / rate;
      run.t_end = 10;
      run.run();
      const double e0 = run.samples.front().seen.energy();
      double most = 0;
      for (std::size_t k = 0; k < run.samples.size(); ++k) {
        const double e = run.samples[k].seen.energy();
        most = std::max(most, e / e0);
        ASSERT_NEAR((e - 0.5 * g * run.dt * run.path[k].velocity[2]) / e0, 1, 1e-12) << rate << " " << run.samples[k].t;
      }
      EXPECT_LE(most, rate == 240 ? 1.01 : 1 + 0.4 * (before - 1)) << rate;
      before = most;
    }
  }
}

// A block that sticks on an incline under its friction angle, one that slides over it.
TEST(Incline, StickIsStickAndSlipIsTheClosedForm) {
  const double angle = 0.3;
  for (const Timing timing : {Timing::at_step, Timing::located}) {
    for (const double friction : {0.2, 0.4}) {
      ContactRun run;
      const Vector normal(std::sin(angle), 0, std::cos(angle)), down(std::cos(angle), 0, -std::sin(angle));
      BodyStart start{.position = 0.25 * normal};
      start.orientation = {std::cos(angle / 2), 0, std::sin(angle / 2), 0};
      run.add(2, std::make_shared<Box>(Vector(0.5, 0.5, 0.25)), start, 0, friction);
      run.add_floor(0, friction, normal);
      run.add_gravity();
      run.timing = timing;
      run.t_end = friction > std::tan(angle) ? 10 : 2;
      run.run();
      const Vector moved = run.path.back().position - start.position;
      if (friction > std::tan(angle)) {
        EXPECT_LT(moved.norm(), 1e-9);
      } else {
        const double a = g * (std::sin(angle) - friction * std::cos(angle));
        EXPECT_NEAR(moved.dot(down), 0.5 * a * 4, 0.5 * a * 4 * 2e-3);
        EXPECT_NEAR(run.path.back().velocity.dot(down), a * 2, 1e-4);
        EXPECT_NEAR(run.losses.friction, friction * 2 * g * std::cos(angle) * moved.dot(down), 1e-2);
      }
    }
  }
}

// Slip to roll: v = 5 v0/7 from t = 2 v0/(7 μ g).
TEST(SlipToRoll, TransitionAndSpeed) {
  const double v0 = 3, friction = 0.25, when = 2 * v0 / (7 * friction * g);
  for (const Timing timing : {Timing::at_step, Timing::located}) {
    ContactRun run;
    run.add(1.5, std::make_shared<Sphere>(0.2), {.position = {0, 0, 0.2}, .velocity = {v0, 0, 0}}, 0, friction);
    run.add_floor(0, friction);
    run.add_gravity();
    run.timing = timing;
    run.t_end = 1;
    run.run();
    double rolls = 0;
    for (std::size_t k = 0; k < run.path.size(); ++k) {
      const double slip = run.path[k].velocity[0] - 0.2 * run.path[k].angular_velocity[1];
      if (slip > 1e-6) rolls = run.samples[k].t + run.dt;
    }
    EXPECT_NEAR(rolls, when, run.dt);
    EXPECT_NEAR(run.path.back().velocity[0], 5 * v0 / 7, 1e-4);
  }
}

// The error of an impact's time falls with the order of the method.
TEST(Located, TimesHaveTheOrderOfTheMethod) {
  const auto first_impact = [](const char* method, double h) {
    ContactRun run;  // a brick that spins freely: no method is exact
    run.add(1, std::make_shared<Box>(Vector(0.2, 0.5, 0.8)), {.position = {0, 0, 3}, .angular_velocity = {3, 4, 2}},
            0.5);
    run.add_floor();
    run.add_gravity();
    run.method = method;
    run.dt = h;
    run.t_end = 0.8;
    run.run();
    return run.impacts.empty() ? 0 : run.impacts.front().t;
  };
  const double exact = first_impact("odeint_fehlberg78", 0);
  EXPECT_NEAR(first_impact("rk4", 1e-3), exact, 1e-10);
  EXPECT_NEAR(first_impact("cvode_adams", 0), exact, 1e-8);
  struct Case {
    const char* method;
    int order;
    double h;
  };
  for (const Case& c : {Case{"semi_implicit_euler_exp", 1, 1e-3}, {"explicit_midpoint", 2, 4e-3}, {"rk4", 4, 4e-2}}) {
    const double coarse = std::abs(first_impact(c.method, c.h) - exact),
                 fine = std::abs(first_impact(c.method, c.h / 4) - exact);
    EXPECT_NEAR(std::log2(coarse / fine) / 2, c.order, 0.4) << c.method << " " << coarse << " " << fine;
  }
}

// One centre, one attitude, centres below the floor: no body is thrown, and at the step they part.
TEST(DegenerateStarts, GiveNoVelocity) {
  const auto box = std::make_shared<Box>(Vector(0.5, 0.5, 0.5));
  const auto ball = std::make_shared<Sphere>(0.5);
  struct Start {
    ShapePointer shape;
    std::vector<Vector> at;
    bool floor;
  };
  const std::vector<Start> starts = {{box, {{0, 0, 0}, {0, 0, 0}}, false},
                                     {ball, {{0, 0, 0}, {0, 0, 0}}, false},
                                     {ball, {{0, 0, -0.4}}, true},
                                     {box, {{0, 0, 0.2}, {0.1, 0, 0.3}}, true}};
  for (const Timing timing : {Timing::at_step, Timing::located}) {
    for (const ResponseEntry& response : impulse_responses()) {
      for (const char* narrow : {"sat", "gjk"}) {
        for (const Start& start : starts) {
          ContactRun run;
          for (const Vector& at : start.at) run.add(1, start.shape, {.position = at}, 0.3, 0.5);
          if (start.floor) {
            run.add_floor(0, 0.5);
            run.add_gravity();
          }
          run.timing = timing;
          run.response = response.name;
          run.narrow_phase = narrow;
          run.dt = 1e-2;
          run.run();
          ASSERT_TRUE(run.end.y.allFinite());
          for (const auto& body : run.path) ASSERT_LT(body.velocity.norm(), 1e-6) << response.name << " " << narrow;
          if (timing == Timing::at_step) {
            EXPECT_GT((run.path.back().position - start.at[0]).norm(), 0.08) << response.name << " " << narrow;
          }
        }
      }
    }
  }
}

TEST(ContactRuns, GiveTheSameBytes) {
  for (const Timing timing : {Timing::at_step, Timing::located}) {
    VectorX<double> before;
    for (int k = 0; k < 2; ++k) {
      ContactRun run = dropped_cube(0.4, {1, 2, 0.5});
      run.timing = timing;
      run.t_end = 2;
      run.run();
      if (k == 1) {
        EXPECT_EQ(run.end.y, before);
      }
      before = run.end.y;
    }
  }
}

}  // namespace
}  // namespace polhode::contact_dynamics_test
