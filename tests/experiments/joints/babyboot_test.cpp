// SPDX-License-Identifier: BSD-3-Clause
// Kane's pendulum of two hinges, a benchmark of Drake, against its two freedoms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/experiments/joints/joint_run.hpp"
#include "tests/experiments/joints/reduced_motion.hpp"

namespace polhode::study::joints_tests::babyboot_test {
namespace {

struct Angles {
  double rod, plate;  ///< degrees
};

/// qA, qB after t (s), from Lagrange's equations. With ω = qA' along x of the rod, turned into the plate's axes by qB,
/// the kinetic energy is J(qB) qA'^2 / 2 + IBz qB'^2 / 2 and the potential energy -(mA LA + mB LB) g cos qA. Unit: g,
/// cm, s.
Angles angles_after(long double t) {
  constexpr long double gravity = 981, rod = 50, across = 2500, along = 500, swivel = 2000;
  constexpr long double moment = 10 * 7.5L + 100 * 20, fixed = rod + 10 * 7.5L * 7.5L + 100 * 20 * 20;
  const auto rate = [&](const Reduced<4>& y) -> Reduced<4> {
    const auto [swing, turn, swing_rate, turn_rate] = y;
    const long double s = std::sin(turn), c = std::cos(turn), slope = (across - along) * s * c;
    return {swing_rate, turn_rate,
            (2 * slope * swing_rate * turn_rate - moment * gravity * std::sin(swing)) /
                (fixed + across * c * c + along * s * s),
            -slope * swing_rate * swing_rate / swivel};
  };
  const long double degree = std::numbers::pi_v<long double> / 180;
  const Reduced<4> y = reduced_motion<4>(rate, {90 * degree, degree, 0, 0}, t, static_cast<int>(t * 2e4L));
  return {static_cast<double>(y[0] / degree), static_cast<double>(y[1] / degree)};
}

TEST(Babyboot, ReducedMotionIsThePublishedOne) {
  const Angles end = angles_after(5);
  EXPECT_NEAR(end.rod, -45.197756656573863, 1e-11);
  EXPECT_NEAR(end.plate, -328.02140542993792, 1e-11);
}

/// An error of the start grows about 240 times until 5 s, so that 2e-9 degrees are kept.
TEST(Babyboot, RodAndPlateKeepTheirDigits) {
  for (const double t : {2.0, 5.0}) {
    SCOPED_TRACE(t);
    const End end = run("babyboot", 1e-4, t);
    const Angles exact = angles_after(static_cast<long double>(t));
    const Matrix3<double> rod = end.motion(0).rotation, plate = rod.transpose() * end.motion(1).rotation;
    const double degree = std::numbers::pi / 180;
    const double swing = std::atan2(rod(2, 1), rod(1, 1)) / degree,
                 turn = std::atan2(plate(1, 0), plate(0, 0)) / degree;
    EXPECT_NEAR(std::remainder(swing - exact.rod, 360), 0, 2e-9);
    EXPECT_NEAR(std::remainder(turn - exact.plate, 360), 0, 2e-9);
    EXPECT_LT(end.largest_gap, 1e-13);
  }
}

}  // namespace
}  // namespace polhode::study::joints_tests::babyboot_test
