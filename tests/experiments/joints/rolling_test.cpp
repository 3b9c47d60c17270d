// SPDX-License-Identifier: BSD-3-Clause
// A disk and a hoop that roll: at which rates an upright one begins to fall over, and turns that stay as they are.
//
// θ is the angle of the axis from the vertical, ψ' the rate of the turn about the vertical, ω3 the angular velocity
// along the axis, A and C the moments across the axis and along it. The equations of the motion are
//   (A + m r²) θ'' = A ψ'² sin θ cos θ - (C + m r²) ω3 ψ' sin θ - m g r cos θ,
//   A (ψ' sin θ)' = C ω3 θ' - A ψ' θ' cos θ,   (C + m r²) ω3' = m r² θ' ψ' sin θ.
// A small lean δ = θ - π/2 has δ'' = -κ δ. Of straight rolling at ω3 = ω, ψ' = C ω δ/A and
//   (A + m r²) κ = C (C + m r²) ω²/A - m g r; it vanishes at g/(3r) for a disk and g/(4r) for a hoop.
// Of spinning on edge at ψ' = Ω, ω3 = m r² Ω δ/(C + m r²) and
//   (A + m r²) κ = (A + m r²) Ω² - m g r; it vanishes at 4g/(5r) for a disk and 2g/(3r) for a hoop.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/experiments/joints/joint_run.hpp"

namespace polhode::study::joints_tests::rolling_test {
namespace {

constexpr double pull = 9.81, weight = 15;  // acceleration of gravity, m/s²; mass, kg; the radius is 1 m

enum class Wheel { disk, hoop };
enum class Upright { rolls, spins };

/// A wheel as in the scenario `rolling_disk` with another start, which is free of slip. `up`: from the contact point to
/// the centre.
Problem wheel_with(Wheel wheel, const Vector& centre, const Quaternion<double>& orientation, const Vector& up,
                   const Vector& angular_velocity) {
  Problem problem = problem_of("rolling_disk");
  const double part = wheel == Wheel::disk ? 0.5 : 1;  // share of m r² in the inertia about the axis
  problem.bodies[0].inertia = (weight * part * Vector(0.5, 0.5, 1)).asDiagonal();
  BodyStart& start = problem.starts[0];
  start.position = centre;
  start.orientation = orientation;
  start.angular_velocity = angular_velocity;
  start.velocity = angular_velocity.cross(up);
  return problem;
}

/// The sine of the lean after t (s), of an upright wheel that starts to lean at `lean_rate` (rad/s).
double lean_after(Wheel wheel, Upright motion, double rate, double lean_rate, double t, double dt) {
  const Vector turns = motion == Upright::rolls ? Vector(lean_rate, rate, 0) : Vector(lean_rate, 0, rate);
  const double half = std::sqrt(0.5);
  const End end = run(wheel_with(wheel, {0, 0, 1}, {half, half, 0, 0}, {0, 0, 1}, turns), dt, t);
  return end.motion(0).rotation(2, 2);
}

/// κ (1/s²) at the square of a rate. Leans at t and 2t are as sin √κ t to sin 2√κ t: half their ratio is cos √κ t.
double restoring(Wheel wheel, Upright motion, double square) {
  constexpr double t = 0.5, start = 1e-5;
  const auto lean = [&](double after) { return lean_after(wheel, motion, std::sqrt(square), start, after, 1e-3); };
  const double half_ratio = lean(2 * t) / (2 * lean(t));
  const double root = (half_ratio < 1 ? std::acos(half_ratio) : std::acosh(half_ratio)) / t;
  return half_ratio < 1 ? root * root : -root * root;
}

struct Threshold {
  const char* name;
  Wheel wheel;
  Upright motion;
  double square;  ///< square of the rate, rad²/s²
};

const Threshold thresholds[] = {{"disk that rolls", Wheel::disk, Upright::rolls, pull / 3},
                                {"hoop that rolls", Wheel::hoop, Upright::rolls, pull / 4},
                                {"disk that spins", Wheel::disk, Upright::spins, 4 * pull / 5},
                                {"hoop that spins", Wheel::hoop, Upright::spins, 2 * pull / 3}};

/// The zero of κ by the secant through two rates, which the motion itself confirms. Nothing of it is from the formulas.
TEST(RollingWheel, ThresholdsOfStability) {
  for (const Threshold& of : thresholds) {
    SCOPED_TRACE(of.name);
    const double low = 1, high = 12, at_low = restoring(of.wheel, of.motion, low),
                 at_high = restoring(of.wheel, of.motion, high);
    EXPECT_LT(at_low, 0) << "falls over";
    EXPECT_GT(at_high, 0) << "rights itself";
    const double found = low - at_low * (high - low) / (at_high - at_low);
    EXPECT_NEAR(found / of.square, 1, 1e-7);
    EXPECT_NEAR(restoring(of.wheel, of.motion, found), 0, 1e-6);
  }
}

/// At rates 1 % below the threshold a lean grows more than ten-thousandfold in 30 s, and 1 % above it stays as small.
TEST(RollingWheel, LeanGrowsBelowTheThresholdOnly) {
  for (const Threshold& of : thresholds) {
    SCOPED_TRACE(of.name);
    constexpr double start = 1e-8;
    const auto growth = [&](double part) {
      return std::abs(lean_after(of.wheel, of.motion, part * std::sqrt(of.square), start, 30, 5e-3)) / start;
    };
    const double below = growth(0.99), above = growth(1.01);
    EXPECT_GT(below, 1e4);
    EXPECT_LT(above, 5);
  }
}

/// A steady turn: (C + m r²) ω3 ψ' sin θ = A ψ'² sin θ cos θ - m g r cos θ. The centre goes round a circle.
TEST(RollingWheel, SteadyTurnStaysOne) {
  for (const double theta : {0.6, 1.0, 1.4}) {
    for (const double turn : {1.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << theta << " rad, " << turn << " rad/s");
      const double s = std::sin(theta), c = std::cos(theta);
      const double spin = (0.25 * turn * turn * s * c - pull * c) / (1.5 * turn * s);
      const Vector axis(s, 0, c), up(-c, 0, s);  // `up` is from the contact point to the centre
      const Problem problem = wheel_with(Wheel::disk, {0, 0, s}, {std::cos(theta / 2), 0, std::sin(theta / 2), 0}, up,
                                         spin * axis + turn * s * up);
      const double t = 3, radius = -spin / turn;
      const End end = run(problem, 5e-4, t);
      const double cosine = std::cos(turn * t), sine = std::sin(turn * t);
      const Vector centre(radius * (cosine - 1), radius * sine, s), turned(s * cosine, s * sine, c);
      EXPECT_LT((end.point(0, Vector::Zero()) - centre).norm(), 1e-10);
      EXPECT_LT((end.motion(0).rotation.col(2) - turned).norm(), 1e-10);
      EXPECT_NEAR(end.motion(0).angular_velocity.dot(turned), spin, 1e-10);
    }
  }
}

}  // namespace
}  // namespace polhode::study::joints_tests::rolling_test
