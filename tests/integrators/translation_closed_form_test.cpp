// SPDX-License-Identifier: BSD-3-Clause
// Translation by the textbook schemes in closed form: energy per step, stability and modified energy of an oscillator,
// and free fall.
#include <algorithm>
#include <numbers>

#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::translation_closed_form_test {
namespace {

constexpr double oscillator_rate = 2.0;  // rad/s

// Explicit Euler multiplies the energy of an oscillator by 1 + (hω)² at each step, the explicit midpoint by 1 +
// (hω)⁴/4.
TEST(Oscillator, ExplicitMethodsFeedIt) {
  for (const double h : {0.01, 0.3, 1.0}) {
    const double x = h * oscillator_rate;
    Motion euler("explicit_euler", oscillator(oscillator_rate), world_quaternion),
        midpoint("explicit_midpoint", oscillator(oscillator_rate), world_quaternion),
        rk4("rk4", oscillator(oscillator_rate), world_quaternion);
    const double start = euler.energy();
    for (int n = 1; n <= 50; ++n) {
      euler.steps(h, 1);
      midpoint.steps(h, 1);
      rk4.steps(h, 1);
      EXPECT_NEAR(euler.energy() / start / std::pow(1 + x * x, n), 1, 1e-14 * n);
      EXPECT_NEAR(midpoint.energy() / start / std::pow(1 + std::pow(x, 4) / 4, n), 1, 1e-14 * n);
      EXPECT_NEAR(rk4.energy() / start / std::pow(1 - std::pow(x, 6) / 72 + std::pow(x, 8) / 576, n), 1, 1e-14 * n);
    }
  }
}

// The largest energy of 4000 steps, relative to the first.
double growth_of_oscillator(const char* method, double h_omega) {
  Motion run(method, oscillator(oscillator_rate), world_quaternion);
  const double start = run.energy();
  double most = 1;
  for (int n = 0; n < 4000; ++n) {
    run.steps(h_omega / oscillator_rate, 1);
    most = std::max(most, run.energy() / start);
  }
  return most;
}

// Stable for hω < 2 (semi-implicit Euler) and hω < 2√2 (RK4); explicit Euler never.
TEST(Oscillator, StabilityLimits) {
  EXPECT_LT(growth_of_oscillator("semi_implicit_euler", 1.99), 1000);
  EXPECT_GT(growth_of_oscillator("semi_implicit_euler", 2.01), 1e100);
  const double limit = 2 * std::numbers::sqrt2;
  EXPECT_EQ(growth_of_oscillator("rk4", 0.999 * limit), 1);
  EXPECT_GT(growth_of_oscillator("rk4", 1.001 * limit), 1e3);
  EXPECT_GT(growth_of_oscillator("explicit_euler", 0.05), 1e3);
}

// Semi-implicit Euler keeps E − (h/2) k x·v of an oscillator: its own energy is that of a neighbour.
TEST(Oscillator, SemiImplicitEulerKeepsAModifiedEnergy) {
  const double h = 0.1, k = 0.5 * oscillator_rate * oscillator_rate;
  Motion run("semi_implicit_euler", oscillator(oscillator_rate), world_quaternion);
  const auto modified = [&] { return run.energy() - h / 2 * k * run.position().dot(run.velocity()); };
  const double start = modified();
  for (int n = 0; n < 1000; ++n) {
    run.steps(h, 1);
    ASSERT_NEAR(modified(), start, 1e-13 * start);
  }
}

// Free fall: semi-implicit Euler keeps E − (h/2) m g v, explicit Euler E + (h/2) m g v, v upward; RK4 is exact.
TEST(FreeFall, ModifiedEnergies) {
  const double h = 0.01, m = 10, g = 9.8;
  for (const auto& [method, sign] : {std::pair("semi_implicit_euler", -1.0), {"explicit_euler", 1.0}, {"rk4", 0.0}}) {
    Motion run(method, peters_hsu(), body_quaternion);
    // The rotation has an energy of its own.
    const auto modified = [&, s = sign] {
      return m * (0.5 * run.velocity().squaredNorm() + g * run.position()[2] + s * h / 2 * g * run.velocity()[2]);
    };
    const double start = modified();
    for (int n = 0; n < 500; ++n) {
      run.steps(h, 1);
      ASSERT_NEAR(modified(), start, 1e-12 * start) << method;
    }
  }
}

// Peters & Hsu: the position error of semi-implicit Euler is ½ g h T, and of the two half steps of Simbody's half of
// it.
TEST(FreeFall, PositionErrorOfSemiImplicitEuler) {
  for (const double h : {1e-4, 1e-3}) {
    Motion run("semi_implicit_euler", peters_hsu(), world_quaternion);
    run.steps(h, std::lround(10 / h));
    const V3 exact(-20, 20, 80 - 0.5 * 9.8 * 100);
    EXPECT_NEAR((run.position() - exact).norm(), 0.5 * 9.8 * h * 10, 1e-9);
  }
}

}  // namespace
}  // namespace polhode::by_hand::translation_closed_form_test
