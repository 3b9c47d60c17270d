// SPDX-License-Identifier: BSD-3-Clause
// Haug's slider-crank in space against its one freedom, the crank's angle, for both readings of its definition.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/experiments/joints/joint_run.hpp"
#include "tests/experiments/joints/reduced_motion.hpp"

namespace polhode::study::joints_tests::slider_crank_test {
namespace {

/// The mechanism at one crank angle φ (rad) from upright: the crank's end is at b = (0, 0.1 - 0.08 sin φ, 0.12 + 0.08
/// cos φ), the slider at (x, 0, 0), the rod's direction is u = ((x, 0, 0) - b)/0.3. Derivatives are those by φ.
struct CrankAngle {
  long double x;        ///< m
  long double inertia;  ///< inertia, kg m²; the kinetic energy is inertia φ'^2 / 2
  long double height;   ///< potential energy over 9.81 m/s², kg m

  /// `centre`: of the crank's mass, as a part of the crank's length from A.
  CrankAngle(long double angle, long double centre) {
    constexpr long double crank = 0.08L, rod = 0.3L;
    const long double s = std::sin(angle), c = std::cos(angle);
    const long double y = 0.1L - crank * s, z = 0.12L + crank * c, dy = -crank * c, dz = -crank * s;
    x = std::sqrt(rod * rod - y * y - z * z);
    const long double dx = -(y * dy + z * dz) / x;
    const long double ux = x / rod, uy = -y / rod, uz = -z / rod, dux = dx / rod, duy = -dy / rod, duz = -dz / rod;
    // The cross turns about x with the azimuth of u, and about an axis that is perpendicular to u and to x. Only the
    // first rate has a part along u.
    const long double azimuth = (uy * duz - uz * duy) / (uy * uy + uz * uz), spin = azimuth * ux;
    inertia = 1e-4L + 0.12L * centre * centre * crank * crank  // the crank
              + 0.5L * (dx * dx + dy * dy + dz * dz) / 4       // the rod, its centre
              + 4e-3L * (dux * dux + duy * duy + duz * duz)    // the rod's turn across its line
              + 4e-4L * spin * spin                            // the rod's turn about its line
              + 2.0L * dx * dx;                                // the slider
    height = 0.12L * centre * crank * c + 0.5L * z / 2;
  }
};

/// The crank's angle after t (s), by the conservation of energy: its rate is 6 rad/s at the start and never 0.
long double crank_after(long double t, long double centre) {
  const CrankAngle start(0, centre);
  const long double gravity = 9.81L, energy = start.inertia * 36 / 2 + gravity * start.height;
  const auto rate = [&](const Reduced<1>& angle) {
    const CrankAngle now(angle[0], centre);
    return Reduced<1>{std::sqrt(2 * (energy - gravity * now.height) / now.inertia)};
  };
  return reduced_motion<1>(rate, {0}, t, static_cast<int>(t * 2e4L))[0];
}

TEST(SliderCrank, ReducedMotionIsThePublishedOne) {
  EXPECT_NEAR(static_cast<double>(crank_after(0.5L, 0)), 5.24989884257890290, 1e-13);
  EXPECT_NEAR(static_cast<double>(crank_after(1, 0)), 10.4840738385243105, 1e-13);
  EXPECT_NEAR(static_cast<double>(crank_after(5, 0)), 51.3694398879306938, 1e-13);
  EXPECT_NEAR(static_cast<double>(CrankAngle(crank_after(5, 0), 0).x), 0.254650085467318617, 1e-13);
  EXPECT_NEAR(static_cast<double>(crank_after(1, 0.5L)), 10.913590729864668, 1e-13) << "the scenario file states it";
}

/// The difference of the crank's angle from an angle (rad), apart from full turns.
double angle_error(const End& end, long double angle) {
  const Matrix3<double> crank = end.motion(0).rotation;
  return std::remainder(std::atan2(crank(2, 1), crank(1, 1)) - static_cast<double>(angle), 2 * std::numbers::pi);
}

TEST(SliderCrank, CrankWithItsMassCentreAtTheBearing) {
  for (const double t : {0.5, 1.0}) {
    SCOPED_TRACE(t);
    const End end = run("slider_crank", 2.5e-4, t);
    EXPECT_NEAR(angle_error(end, t == 1 ? 10.4840738385243105L : 5.24989884257890290L), 0, 1e-9);
    EXPECT_LT(end.largest_gap, 1e-13);
  }
  const End end = run("slider_crank", 1e-4, 5);
  EXPECT_NEAR(angle_error(end, 51.3694398879306938L), 0, 1e-9);
  EXPECT_NEAR(end.point(2, {0, 0, 0})[0], 0.254650085467318617, 1e-9);
}

TEST(SliderCrank, CrankWithItsMassCentreHalfWay) {
  for (const double t : {0.5, 1.0, 5.0}) {
    SCOPED_TRACE(t);
    const End end = run("slider_crank_half_way", 1e-4, t);
    const long double angle = crank_after(static_cast<long double>(t), 0.5L);
    EXPECT_NEAR(angle_error(end, angle), 0, 1e-9);
    EXPECT_NEAR(end.point(2, {0, 0, 0})[0], static_cast<double>(CrankAngle(angle, 0.5L).x), 1e-9);
    EXPECT_LT(end.largest_gap, 1e-13);
  }
}

}  // namespace
}  // namespace polhode::study::joints_tests::slider_crank_test
