// SPDX-License-Identifier: BSD-3-Clause
// The error along the polhode and off it: known shifts are given back, and methods err as they are known to.
#include "experiments/study/metrics/polhode_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/study/run/run.hpp"
#include "tests/experiments/study/metrics/free_body.hpp"

namespace polhode::study::polhode_error_test {
namespace {

/// The body in the exact motion at t + shift, its momentum in the body stretched by a factor.
BodySnapshot<double> shifted(const Problem& problem, double t, double shift, double factor) {
  const FreeTop exact(problem.bodies[0].inertia, identity_quaternion<double>(), problem.starts[0].angular_velocity);
  BodySnapshot<double> body{};
  body.rotation.setIdentity();
  body.angular_velocity = factor * exact.at(t + shift).angular_velocity_body;
  return body;
}

const std::vector<Problem>& tops() {
  static const std::vector<Problem> all = {free_body({0.6, 0.8, 1.0}, {3, 0.5, -0.9}),
                                           free_body({2, 3, 1}, {0, std::sqrt(0.51), std::sqrt(3)}),
                                           free_body({3, 5, 9}, {0, 0.4, 0.01 / 9}),  // near the separatrix
                                           free_body({2, 2, 1}, {1, 0, 3})};
  return all;
}

TEST(PolhodeError, GivesAShiftBack) {
  for (const Problem& problem : tops()) {
    const auto system = make_system<double>(problem, {});
    for (const double rate : {1e-9, -1e-4, 0.3}) {
      auto error = PolhodeError::of(*system);
      ASSERT_TRUE(error);
      for (double t = 0; t <= 200; t += 0.5) {
        const auto at = error->at(t, shifted(problem, t, rate * t, 1));
        ASSERT_NEAR(at.phase, rate * t, 1e-10 + 1e-12 * t) << rate << " at " << t;
        EXPECT_NEAR(at.phase_rad, at.phase * problem.starts[0].angular_velocity.norm(), 1e-9);
        EXPECT_LE(at.off, 1e-12);
      }
    }
  }
}

TEST(PolhodeError, GivesADistanceBack) {
  for (const Problem& problem : tops()) {
    const auto system = make_system<double>(problem, {});
    auto error = PolhodeError::of(*system);
    for (double t = 0; t <= 50; t += 0.5) {
      // A longer momentum in the same direction: the nearest point is the same, since ẏ is at right angles to y.
      const auto at = error->at(t, shifted(problem, t, 0.01 * t, 1.001));
      ASSERT_NEAR(at.phase, 0.01 * t, 1e-7);
      ASSERT_NEAR(at.off, 0.001, 1e-7);
    }
  }
}

/// A body whose nearest point is known: at t + phase, aside by the fraction `off` of |y| at right angles to ẏ.
struct Aside {
  BodySnapshot<double> body{};
  double speed = 0, curvature = 0;  ///< |ẏ|/|y|; of half the squared distance in the phase, over |ẏ|²

  Aside(const Problem& problem, const FreeTop& exact, double at, double off) {
    const Matrix3<double>& inertia = problem.bodies[0].inertia;
    const Vector3<double> omega = exact.angular_velocity_body(at), y = inertia * omega, rate = y.cross(omega);
    const Vector3<double> second = rate.cross(omega) + y.cross(inertia.inverse() * rate);
    const Vector3<double> aside = off * y.norm() * rate.cross(y).normalized();
    body.rotation.setIdentity();
    body.angular_velocity = inertia.inverse() * (y + aside);
    speed = rate.norm() / y.norm();
    curvature = 1 - aside.dot(second) / rate.squaredNorm();
  }
};

TEST(PolhodeError, FindsTheNearestPointToRoundOff) {
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  for (const Problem& problem : tops()) {
    const auto system = make_system<double>(problem, {});
    const Matrix3<double>& inertia = problem.bodies[0].inertia;
    const Vector3<double>& omega = problem.starts[0].angular_velocity;
    const FreeTop exact(inertia, identity_quaternion<double>(), omega);
    const double fastest = inertia.inverse().norm() * (inertia * omega).norm();
    // About where the Taylor polynomial is left for elliptic functions, 1e-4, and far on both sides.
    for (const double turn : {1e-12, 1e-8, 2e-5, 7e-5, 9.9e-5, 1.01e-4, 1e-3, 1e-2, 0.1}) {
      for (const double off : {0.0, 1e-10, 1e-5, -0.01}) {
        auto error = PolhodeError::of(*system), told = error;
        for (double t = 0; t <= 8; t += 0.25) {
          // The error grows from call to call and swings, which no extrapolation foresees.
          const double phase = turn / fastest * (1 + 0.3 * std::sin(5 * t));
          const Aside known(problem, exact, t + phase, off);
          if (known.curvature < 0.3) break;  // as far aside as the curve bends; another point may be nearer
          const auto at = error->at(t, known.body);
          const double round_off = 3 * rounding * (1 + fastest * t);
          ASSERT_NEAR(at.phase, phase, round_off / (known.speed * known.curvature))
              << turn << ' ' << off << " at " << t;
          ASSERT_NEAR(at.off, std::abs(off), round_off);
          // The exact angular velocity changes nothing, it only saves time.
          const auto same = told->at(t, known.body, exact.at(t).angular_velocity_body);
          ASSERT_EQ(same.phase, at.phase);
          ASSERT_EQ(same.off, at.off);
        }
      }
    }
  }
}

TEST(PolhodeError, HasNoMeaningWhereThereIsNoCurve) {
  const Problem sphere = free_body({1, 1, 1}, {1, 2, 3}), spin = free_body({1, 2, 3}, {0, 0, 2});
  EXPECT_FALSE(PolhodeError::of(*make_system<double>(sphere, {})));
  EXPECT_FALSE(PolhodeError::of(*make_system<double>(spin, {})));
  for (const char* name : {"lagrange_top", "spring_box", "two_bodies", "oscillator", "ball_joint_top"}) {
    EXPECT_FALSE(PolhodeError::of(*make_system<double>(ScenarioSource::open(name).resolve().problem, {}))) << name;
  }
  EXPECT_TRUE(PolhodeError::of(*make_system<double>(ScenarioSource::open("peters_hsu").resolve().problem, {})));
}

RunResult result_of(const std::string& method, double dt) {
  const Scenario scenario = ScenarioSource::open("hairer_vilmart").resolve();
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = method;
  config.formulation.angular_state = AngularState::velocity_body;
  config.dt = dt;
  config.t_end = 10;
  return carry_out(config, scenario, {}, nullptr);
}

TEST(PolhodeError, TellsMethodsApart) {
  // It conserves what makes the polhode, and is late on it by O(h²).
  const RunResult dmv = result_of("dmv", 0.01), coarse = result_of("dmv", 0.02);
  EXPECT_LE(*dmv.polhode_off_error_max_rel, 1e-13);
  EXPECT_GE(*dmv.polhode_phase_error_max, 1e-4);
  EXPECT_NEAR(*coarse.polhode_phase_error_max / *dmv.polhode_phase_error_max, 4, 0.1);
  const RunResult euler = result_of("explicit_euler", 0.001);
  EXPECT_GE(*euler.polhode_off_error_max_rel, 1e-4);
  EXPECT_GE(*euler.polhode_phase_error_max_rad, 1e-4);
}

}  // namespace
}  // namespace polhode::study::polhode_error_test
