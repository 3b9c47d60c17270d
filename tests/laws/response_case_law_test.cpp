// SPDX-License-Identifier: BSD-3-Clause
// The laws of every response where the answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/response/position_correction.hpp"
#include "tests/laws/response_trials.hpp"

namespace polhode::laws::response_case_law_test {
namespace {

using Vector = Vector3<double>;
using Matrix = Matrix3<double>;

class ResponseCase : public ResponseTrial {
 protected:
  /// Tolerance of velocities after steps, m/s. It is larger for a response whose iteration in a step ends early.
  double in_a_step() const { return GetParam().name == "sequential_impulses" ? 1e-5 : 1e-9; }
};

ImpulseContact touch(std::uint32_t a, std::uint32_t b, const Vector& normal, const Vector& point, double restitution,
                     double friction = 0) {
  ImpulseContact c;
  c.a = a;
  c.b = b;
  c.normal = normal;
  c.point = point;
  c.restitution = restitution;
  c.friction = friction;
  return c;
}

/// Two cubes, one on the other and aside of it, the upper one falling with v.
ImpulseScene two_cubes(double mass, double side, double aside, double v, double restitution) {
  ImpulseScene s;
  s.bodies = {cube(mass, side, {-0.5 * aside, 0, 0.5 * side}, Matrix::Identity()),
              cube(mass, side, {0.5 * aside, 0, -0.5 * side}, Matrix::Identity())};
  s.bodies[0].velocity = {0, 0, -v};
  for (int k = 0; k < 4; ++k) {
    const Vector corner((k % 2 ? 0.5 : -0.5) * (side - aside), (k / 2 ? 0.5 : -0.5) * side, 0);
    s.contacts.push_back(touch(0, 1, {0, 0, 1}, corner, restitution));
  }
  s.meet();
  return s;
}

/// A cube on a floor that cannot move, on its four corners.
ImpulseScene cube_on_floor(double friction) {
  ImpulseScene s;
  s.bodies = {ImpulseBody{}, cube(2, 1, {0.3, -0.2, 0.5}, Matrix::Identity())};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const Vector corner(k % 2 ? 0.5 : -0.5, k / 2 ? 0.5 : -0.5, 0);
    s.contacts.push_back(touch(0, 1, {0, 0, -1}, corner + Vector(0.3, -0.2, 0), 0, friction));
    s.contacts.back().feature = {Feature::Kind::face_vertex, 0, k};
  }
  return s;
}

ImpulseScene cradle(int balls, bool from_the_left) {
  ImpulseScene s;
  for (int i = 0; i < balls; ++i) s.bodies.push_back(ball(0.3, 0.5, {double(i), 0, 0}));
  for (std::uint32_t i = 0; i + 1 < std::uint32_t(balls); ++i)
    s.contacts.push_back(touch(i, i + 1, {-1, 0, 0}, {i + 0.5, 0, 0}, 1));
  if (from_the_left) {
    s.bodies.front().velocity = {1, 0, 0};
  } else {
    s.bodies.back().velocity = {-1, 0, 0};
  }
  s.meet();
  return s;
}

TEST_P(ResponseCase, TwoCubesFaceParallelGetTheClosedForm) {
  const double tolerance = GetParam().name == "single_impulse" ? 1e-15 : 1e-10;
  for (const double restitution : {0.0, 0.4, 1.0}) {
    for (const double aside : {0.0, 0.3, 0.9}) {
      const double m = 2.5, side = 1.3, v = 1.7, arm = 0.5 * aside;
      const ImpulseScene s = two_cubes(m, side, aside, v, restitution), t = after(s);
      const double expected = (1 + restitution) * v / (2 / m + 6 * (2 * arm * arm) / (m * side * side));
      double j = 0;
      for (const ImpulseContact& c : t.contacts) j += c.impulse[2];
      EXPECT_NEAR(j / expected, 1, tolerance) << "aside by " << aside;
      if (restitution == 1) {
        EXPECT_NEAR(kinetic_energy(t.bodies) / kinetic_energy(s.bodies), 1, 1e-12);
      }
    }
    // The impulses act at one point, with different arms.
    const double m = 0.7, side = 0.4, v = 3, arm_a = 0.15, arm_b = 0.05;
    ImpulseScene s;
    s.bodies = {cube(m, side, {-arm_a, 0, 0.5 * side}, Matrix::Identity()),
                cube(m, side, {0, arm_b, -0.5 * side}, Matrix::Identity())};
    s.bodies[0].velocity = {0, 0, -v};
    s.contacts = {touch(0, 1, {0, 0, 1}, Vector::Zero(), restitution)};
    s.meet();
    const double expected = (1 + restitution) * v / (2 / m + 6 * (arm_a * arm_a + arm_b * arm_b) / (m * side * side));
    EXPECT_NEAR(after(s).contacts[0].impulse[2] / expected, 1, tolerance);
  }
}

TEST_P(ResponseCase, NewtonsCradleHasItsStatedOutcome) {
  for (const int balls : {3, 5}) {
    for (const bool left : {true, false}) {
      const ImpulseScene s = after(cradle(balls, left));
      for (int i = 0; i < balls; ++i) {
        const bool first = i == (left ? 0 : balls - 1), last = i == (left ? balls - 1 : 0);
        // One out, or all at once: the first rebounds with 1 − 2 (n − 1)/n, the others go with 2/n.
        const double together = first ? 1 - 2 * (balls - 1) / double(balls) : 2 / double(balls);
        const double speed = GetParam().name == "single_impulse" ? (last ? 1 : 0) : together;
        EXPECT_NEAR(s.bodies[std::size_t(i)].velocity[0], left ? speed : -speed, 1e-10)
            << "ball " << i << " of " << balls;
      }
    }
  }
}

TEST_P(ResponseCase, ABoxOnFourCornersComesToRest) {
  for (const double step : {0.0, 1 / 60.0}) {
    ImpulseScene s = cube_on_floor(0.5);
    for (int k = 0; k < 10; ++k) {
      s.bodies[1].velocity += Vector(0, 0, -9.81 / 60);
      s = after(s, step);
      EXPECT_LE(s.bodies[1].velocity.norm(), 1e-10) << "step " << k;
      EXPECT_LE(s.bodies[1].angular_velocity.norm(), 1e-10) << "step " << k;
    }
  }
}

TEST_P(ResponseCase, ABoxSlidesAndSticks) {
  if (!has_friction()) GTEST_SKIP() << "it has none";
  // A push aside within the cone stops, however it points; one beyond it leaves what the cone cannot take.
  for (const double angle : {0.0, 0.4, 0.8, 2.5}) {
    const Vector aside(std::cos(angle), std::sin(angle), 0);
    for (const double pushed : {0.3, 0.7}) {
      ImpulseScene s = cube_on_floor(0.5);
      for (ImpulseContact& c : s.contacts) c.point[2] = s.bodies[1].position[2];  // no arm: it does not tip
      s.bodies[1].velocity = Vector(0, 0, -1) + pushed * aside;
      s = after(s);
      const Vector expected = std::max(0.0, pushed - 0.5) * aside;
      EXPECT_LE((s.bodies[1].velocity - expected).norm(), 1e-10) << "towards " << angle << " rad with " << pushed;
    }
  }
}

TEST_P(ResponseCase, ABlockOnAnInclineSticksOrSlides) {
  if (!has_friction()) GTEST_SKIP() << "it has none";
  const double g = 9.81, h = 0.01, friction = 0.5;
  for (const double angle : {0.4, 0.6}) {  // the cone's is 0.4636
    response->forget();
    ImpulseScene s = cube_on_floor(friction);
    for (int k = 1; k <= 100; ++k) {
      s.bodies[1].velocity += g * h * Vector(std::sin(angle), 0, -std::cos(angle));
      s = after(s, h);
      const double expected =
          angle < std::atan(friction) ? 0 : g * (std::sin(angle) - friction * std::cos(angle)) * k * h;
      ASSERT_LE((s.bodies[1].velocity - Vector(expected, 0, 0)).norm(), in_a_step())
          << "step " << k << " at " << angle << " rad";
      ASSERT_LE(s.bodies[1].angular_velocity.norm(), in_a_step());
    }
  }
}

TEST_P(ResponseCase, BallsRollOnABoxThatIsPushed) {
  if (!has_friction()) GTEST_SKIP() << "it has none";
  // SimBenchmark's "rolling" (ETH Zürich): a box of 10 kg on the ground carries 25 balls of 1 kg and is pushed by 150
  // N, neither along x nor along y.
  const double mass = 10, radius = 0.1, g = 9.81, h = 0.001;
  ImpulseScene s;
  s.bodies = {ImpulseBody{}, cube(mass, 1, {0, 0, 0.5}, Matrix::Identity())};
  for (std::uint32_t k = 0; k < 4; ++k) {
    s.contacts.push_back(touch(0, 1, {0, 0, -1}, {k % 2 ? 0.5 : -0.5, k / 2 ? 0.5 : -0.5, 0}, 0, 0.4));
    s.contacts.back().feature = {Feature::Kind::face_vertex, 0, k};
  }
  for (std::uint32_t k = 0; k < 25; ++k) {
    const Vector place(0.2 * (k % 5) - 0.4, 0.2 * (k / 5) - 0.4, 1);
    s.bodies.push_back(ball(1, radius, place + Vector(0, 0, radius)));
    s.contacts.push_back(touch(1, 2 + k, {0, 0, -1}, place, 0, 0.8));
  }
  const Vector along = Vector(0.5, 0.866, 0).normalized();
  const double slides = 150 - 0.4 * (mass + 25) * g;  // force of the push, less the ground's friction, N
  const double a_box = slides / (mass + 25 / 3.5), a_ball = a_box / 3.5;
  for (int k = 1; k <= 50; ++k) {
    for (std::size_t i = 1; i < s.bodies.size(); ++i) s.bodies[i].velocity[2] -= g * h;
    s.bodies[1].velocity += 150 / mass * h * along;
    s = after(s, h);
  }
  EXPECT_NEAR(a_box, 0.7385, 1e-4);
  EXPECT_NEAR(a_ball, 0.211, 1e-4);
  EXPECT_LE((s.bodies[1].velocity - 50 * h * a_box * along).norm(), in_a_step());
  for (std::size_t i = 2; i < s.bodies.size(); ++i) {
    EXPECT_LE((s.bodies[i].velocity - 50 * h * a_ball * along).norm(), in_a_step());
  }
}

TEST_P(ResponseCase, ABouncingBallSlipsOrRolls) {
  if (!has_friction()) GTEST_SKIP() << "it has none";
  for (const double friction : {0.1, 2.0}) {
    const double m = 0.4, r = 0.3, e = 0.6;
    ImpulseScene s;
    s.bodies = {ImpulseBody{}, ball(m, r, {0, 0, r})};
    s.bodies[1].velocity = {1.5, -2, -3};
    s.contacts = {touch(0, 1, {0, 0, -1}, Vector::Zero(), e, friction)};
    s.meet();
    s = after(s);
    // The slip loses μ (1 + e) v_n (1 + m r²/I), and no more than there is.
    const double lost = std::min(1.0, friction * (1 + e) * 3 * 3.5 / 2.5);
    EXPECT_NEAR(s.bodies[1].velocity[2], e * 3, 1e-11);
    EXPECT_LE((s.bodies[1].velocity_at(Vector::Zero()) - Vector(1.5, -2, 1.8) * 1 - lost * Vector(-1.5, 2, 0)).norm(),
              1e-10);
  }
}

TEST_P(ResponseCase, PenetrationIsUndoneApartFromTheVelocities) {
  for_scenes(60, {.bodies = 5, .statics = 0.3, .friction = 1, .restitution = 0.5}, [&](ImpulseScene s) {
    response->forget();
    const ImpulseScene touching = after(s, 0.01);
    PortableRandom random(4);
    for (ImpulseContact& c : s.contacts) c.depth = random.uniform(-0.01, 0.1);
    response->forget();
    const ImpulseScene deep = after(s, 0.01);
    ASSERT_EQ(difference(touching, deep), 0);
    for (const ImpulseBody& b : touching.bodies) ASSERT_TRUE(b.shift.isZero(0) && b.turn.isZero(0));
  });
  // A cube that is 5 cm deep rises by a share of that in a step, and ends a little deep.
  ImpulseScene s = cube_on_floor(0.5);
  double depth = 0.05, before = depth;
  for (int k = 0; k < 60; ++k) {
    for (ImpulseContact& c : s.contacts) c.depth = depth;
    s = after(s, 0.01);
    before = depth;
    depth -= s.bodies[1].shift[2];
    ASSERT_LE(before - depth, (PositionCorrectionSettings{}.share + 0.01) * before);
    ASSERT_LE(s.bodies[1].turn.norm(), 1e-3 * before);
  }
  EXPECT_LE(depth, 2e-3);
  EXPECT_GT(depth, 0);
}

TEST_P(ResponseCase, DegenerateScenesGiveNumbers) {
  for (const double step : {0.0, 1e-300, 0.01}) {
    response->forget();
    EXPECT_TRUE(finite(after({}, step)));
    ImpulseScene none;
    none.bodies = {ball(1, 1, Vector::Zero())};
    EXPECT_TRUE(finite(after(none, step)));
    // Coincident centres, and a point at both; then without a normal; then two that cannot move.
    ImpulseScene s;
    s.bodies = {ball(1, 1, Vector::Zero()), ball(2, 1, Vector::Zero())};
    s.bodies[0].velocity = {0, 0, -1};
    s.contacts = {touch(0, 1, {0, 0, 1}, Vector::Zero(), 0.5, 0.5)};
    s.contacts[0].depth = 2;
    s.meet();
    const ImpulseScene together = after(s, step);
    EXPECT_TRUE(finite(together));
    EXPECT_GT(together.contacts[0].impulse[2], 0);
    s.contacts[0].normal.setZero();
    EXPECT_TRUE(finite(after(s, step)));
    EXPECT_EQ(difference(after(s, step), s), 0);
    s.contacts[0].normal = {0, 0, 1};
    s.bodies[0].inverse_mass = s.bodies[1].inverse_mass = 0;
    s.bodies[0].inverse_inertia = s.bodies[1].inverse_inertia = Matrix::Zero();
    EXPECT_TRUE(finite(after(s, step)));
    EXPECT_EQ(difference(after(s, step), s), 0);
  }
}

TEST_P(ResponseCase, RestitutionReflectsTheApproachNotWhatAForceHasAddedSince) {
  ImpulseScene s;
  s.bodies = {ImpulseBody{}, ball(0.4, 0.3, {0, 0, 0.3})};
  s.bodies[1].velocity = {0, 0, -2};
  s.contacts = {touch(0, 1, {0, 0, -1}, Vector::Zero(), 0.5)};
  s.meet();
  s.bodies[1].velocity[2] -= 0.3;
  EXPECT_NEAR(after(s, 0.03).bodies[1].velocity[2], 1, 1e-12);
}

TEST_P(ResponseCase, AWedgeWithOneElasticWallGivesNoEnergy) {
  // The walls press far harder than the ball is fast; what one alone gives back is more than there was.
  for (const double angle : {0.01, 0.1, 0.5}) {
    for (const double friction : {0.0, 0.5}) {
      ImpulseScene s;
      s.bodies = {ImpulseBody{}, ImpulseBody{}, ball(1, 0.2, Vector::Zero())};
      s.bodies[2].velocity = {0, 0, -1};
      const Vector left(-std::cos(angle), 0, -std::sin(angle)), right(std::cos(angle), 0, -std::sin(angle));
      s.contacts = {touch(0, 2, left, 0.2 * left, 1, friction), touch(1, 2, right, 0.2 * right, 0, friction)};
      s.meet();
      const double before = kinetic_energy(s.bodies);
      const ImpulseScene t = after(s);
      EXPECT_LE(kinetic_energy(t.bodies), before * (1 + 1e-12)) << angle;
      // The way from wall to wall takes about 1/angle² pushes.
      if (angle > 0.4 || GetParam().name == "simultaneous") {
        EXPECT_GE(t.bodies[2].velocity[2], -1e-9) << angle;
      }
    }
  }
}

TEST_P(ResponseCase, ABodyOnAPivotOnlyTurns) {
  ImpulseScene s;
  s.bodies = {cube(1, 1, Vector::Zero(), Matrix::Identity()), ball(1, 0.2, {1, 0, 0.2})};
  s.bodies[0].inverse_mass = 0;
  s.bodies[1].velocity = {0, 0, -1};
  s.contacts = {touch(0, 1, {0, 0, -1}, {1, 0, 0}, 1)};
  s.meet();
  const double before = kinetic_energy(s.bodies);
  s = after(s);
  EXPECT_EQ(s.bodies[0].velocity, Vector(Vector::Zero()));
  EXPECT_GT(s.bodies[0].angular_velocity[1], 0.1);
  EXPECT_NEAR(kinetic_energy(s.bodies), before, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ResponseCase, testing::ValuesIn(impulse_responses()),
                         [](const auto& response) { return response.param.name; });

}  // namespace
}  // namespace polhode::laws::response_case_law_test
