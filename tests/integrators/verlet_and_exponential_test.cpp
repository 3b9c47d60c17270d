// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of Heun's method, velocity Verlet and the semi-implicit Euler method with the exponential.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, I.1 and VI; the oscillator has k/m = ω², z = hω.
#include <algorithm>

#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::verlet_and_exponential_test {
namespace {

constexpr double rate = 2.0;  // rad/s

/// The largest energy of the oscillator over 20000 steps of z/ω, relative to the first.
double growth(const char* method, double z) {
  Motion run(method, oscillator(rate), {});
  const double e = run.energy();
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    run.steps(z / rate);
    most = std::max(most, run.energy() / e);
    if (most > 1e9) break;
  }
  return most;
}

TEST(Oscillator, StabilityLimitsOfVerletAndTheExponentialMethod) {
  for (const char* method : {"velocity_verlet", "semi_implicit_euler_exp"}) {
    EXPECT_LT(growth(method, 2 * 0.99), 1e3) << method;
    EXPECT_GT(growth(method, 2 * 1.01), 1e9) << method;
  }
}

// |1 + iz − z²/2|² = 1 + z⁴/4.
TEST(Oscillator, HeunFeedsIt) {
  for (const double z : {0.1, 0.7}) {
    Motion run("heun", oscillator(rate), {});
    double e = run.energy();
    for (int k = 0; k < 50; ++k) {
      run.steps(z / rate);
      EXPECT_NEAR(run.energy() / e / (1 + std::pow(z, 4) / 4), 1, 1e-13);
      e = run.energy();
    }
  }
}

// Verlet keeps ½ m v² + ½ k x² (1 − z²/4), and returns.
TEST(Oscillator, VerletKeepsAModifiedEnergy) {
  for (const double z : {0.1, 1.0, 1.9}) {
    Motion run("velocity_verlet", oscillator(rate), {});
    const auto modified = [&] { return run.measure().kinetic + (1 - z * z / 4) * run.measure().potential; };
    const double start = modified();
    const VectorX<double> y = run.state().y;
    run.steps(z / rate, 1000);
    EXPECT_NEAR(modified() / start, 1, 1e-12);
    run.steps(-z / rate, 1000);
    EXPECT_LT((run.state().y - y).cwiseAbs().maxCoeff(), 1e-12);
  }
}

// Semi-implicit Euler in free fall keeps E − (h/2) m g v, v upward.
TEST(FreeFall, ModifiedEnergyOfTheExponentialMethod) {
  const double h = 0.01;
  Motion run("semi_implicit_euler_exp", peters_hsu(), {});
  const auto modified = [&] {
    const BodySnapshot<double> now = run.body();
    const double fall = 5 * now.velocity.squaredNorm() + 98 * now.position.z();
    return fall - h / 2 * 98 * now.velocity.z();
  };
  const double start = modified();
  run.steps(h, 1000);
  EXPECT_NEAR(modified(), start, 1e-9);
}

// A sphere turns uniformly: the group step is exact in the attitude for any step, in both charts and all frames.
TEST(ConstantRotation, GroupStepsAreExact) {
  Problem p;
  p.bodies.push_back({.name = "sphere"});
  p.starts.push_back({.orientation = quaternion_from_rotation_vector<double>(V3(-1.7, 2.1, 1.2)),
                      .angular_velocity = {0.9, -1.3, 2.1}});
  for (const char* method : {"semi_implicit_euler_exp", "velocity_verlet", "lie_euler", "rkmk4", "lie_midpoint"}) {
    for (const Formulation& f : laws::gyroscopic_formulations()) {
      Motion run(method, p, f);
      run.steps(0.7, 40);
      const Quaternion<double> end =
          product(quaternion_from_rotation_vector<double>(28 * p.starts[0].angular_velocity), p.starts[0].orientation);
      EXPECT_LT(angle_between(run.body().orientation, end), 1e-12) << method << ", " << laws::label(f);
    }
  }
}

}  // namespace
}  // namespace polhode::by_hand::verlet_and_exponential_test
