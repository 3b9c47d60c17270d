// SPDX-License-Identifier: BSD-3-Clause
// Rotation by the textbook schemes in closed form, and the published figures that they must give: growth and phase of
// the two charts, energy per step, secular drift. Sources: stand at each test. θ = h|ω|, y = JΩ (body axes).
#include <algorithm>

#include "core/system/orientation_chart.hpp"
#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::rotation_closed_form_test {
namespace {

using laws::gyroscopic_formulations;
using laws::label;

/// A sphere with I = 1, whose angular velocity is constant to the bit in its own axes.
Problem sphere(const V3& angular_velocity) {
  Problem p;
  p.bodies.push_back({.name = "sphere"});
  p.starts.push_back({.angular_velocity = angular_velocity});
  return p;
}
const V3 turning(0.9, -1.3, 2.1);

const V3 hairer_vilmart_moments(0.6, 0.8, 1.0);

class Textbook : public testing::TestWithParam<AngularState> {};
INSTANTIATE_TEST_SUITE_P(ConstantRotation, Textbook,
                         testing::Values(AngularState::velocity_world, AngularState::velocity_body),
                         [](const auto& param_info) { return std::string(name(param_info.param)); });

// Explicit Euler multiplies q by 1 + ½hω: |q|² by 1 + θ²/4, the angle by 2 atan(θ/2) a step.
TEST_P(Textbook, ExplicitEulerOnTheQuaternion) {
  for (const double h : {1e-3, 0.05, 0.8}) {
    Motion run("explicit_euler", sphere(turning), {Orientation::quaternion, GetParam(), false});
    const double theta = h * turning.norm(), growth = 1 + theta * theta / 4;
    for (int n = 1; n <= 40; ++n) {
      run.steps(h, 1);
      const double square = std::pow(growth, n), angle = n * 2 * std::atan(theta / 2);
      const auto q = run.quaternion();
      EXPECT_NEAR(q.squaredNorm() / square, 1, 1e-14 * n);
      EXPECT_NEAR(run.measure().orientation_defect, std::sqrt(square) - 1, 1e-14 * n * std::sqrt(square));
      const Quaternion<double> expected = quaternion_from_rotation_vector<double>(angle * turning.normalized());
      EXPECT_LT((q / q.norm() - expected).norm(), 1e-14 * n) << "phase, h = " << h;
    }
  }
}

// Explicit Euler multiplies R by 1 + hω*: det by 1 + θ², the angle by atan θ, ‖RᵀR − 1‖_F = √2 ((1 + θ²)ⁿ − 1).
TEST_P(Textbook, ExplicitEulerOnTheMatrix) {
  for (const double h : {1e-3, 0.05, 0.3}) {
    Motion run("explicit_euler", sphere(turning), {Orientation::matrix, GetParam(), false});
    const double theta = h * turning.norm(), growth = 1 + theta * theta;
    for (int n = 1; n <= 40; ++n) {
      run.steps(h, 1);
      const double power = std::pow(growth, n), angle = n * std::atan(theta);
      const Matrix3<double> r = run.matrix();
      EXPECT_NEAR(r.col(0).cross(r.col(1)).dot(r.col(2)) / power, 1, 5e-14 * n);
      EXPECT_NEAR(run.measure().orientation_defect, std::sqrt(2) * (power - 1), 1e-14 * n * power);
      const Matrix3<double> polar = Chart<double, Orientation::matrix>::project(r);
      const Matrix3<double> expected =
          rotation_matrix<double>(quaternion_from_rotation_vector<double>(angle * turning.normalized()));
      EXPECT_LT((polar - expected).norm(), 1e-14 * n) << "phase, h = " << h;
    }
  }
}

// The growth is exact for any sequence of angular velocities: products of 1 + θ_n²/4 and of 1 + θ_n².
TEST(ExplicitEuler, GrowsByTheAngularVelocityOfEachStep) {
  for (const AngularState a :
       {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
    Motion q("explicit_euler", hairer_vilmart(), {Orientation::quaternion, a});
    Motion r("explicit_euler", hairer_vilmart(), {Orientation::matrix, a});
    const double h = 0.02;
    double square = 1, determinant = 1;
    for (int n = 1; n <= 100; ++n) {
      const double theta = h * q.body().angular_velocity.norm();
      // ω and Ω differ in length once the matrix is no rotation; each acts where it is the state.
      const V3 turn = a == AngularState::velocity_body ? r.angular_state() : r.body().angular_velocity;
      square *= 1 + theta * theta / 4;
      determinant *= 1 + h * h * turn.squaredNorm();
      q.steps(h, 1);
      r.steps(h, 1);
      EXPECT_NEAR(q.quaternion().squaredNorm() / square, 1, 1e-15 * (10 + n));
      const Matrix3<double> m = r.matrix();
      EXPECT_NEAR(m.col(0).cross(m.col(1)).dot(m.col(2)) / determinant, 1, 1e-15 * (10 + n));
    }
  }
}

// RK4 multiplies q, and R in the plane of the turn, by 1 + z + z²/2 + z³/6 + z⁴/24 with z = ix, x = θ/2 or θ:
// modulus² 1 − x⁶/72 + x⁸/576, argument x − x⁵/120 + x⁷/336 + O(x⁹).
TEST_P(Textbook, Rk4OnBothCharts) {
  for (const Orientation orientation : {Orientation::quaternion, Orientation::matrix}) {
    const bool quaternion = orientation == Orientation::quaternion;
    for (const double h : {0.02, 0.1, 0.4}) {
      Motion run("rk4", sphere(turning), {orientation, GetParam(), false});
      const double theta = h * turning.norm(), x = quaternion ? theta / 2 : theta;
      const double growth = 1 - std::pow(x, 6) / 72 + std::pow(x, 8) / 576;
      const double argument = std::atan2(x - x * x * x / 6, 1 - x * x / 2 + std::pow(x, 4) / 24);
      const int n = 30;
      run.steps(h, n);
      const double angle = n * argument * (quaternion ? 2 : 1);
      const Quaternion<double> expected = quaternion_from_rotation_vector<double>(angle * turning.normalized());
      EXPECT_LT(angle_between(run.attitude(), expected), 2e-14 * n);
      if (quaternion) {
        EXPECT_NEAR(run.quaternion().squaredNorm() / std::pow(growth, n), 1, 1e-15 * n);
      } else {
        const Matrix3<double> r = run.matrix();
        EXPECT_NEAR(r.col(0).cross(r.col(1)).dot(r.col(2)) / std::pow(growth, n), 1, 1e-15 * n);
      }
    }
  }
}

// The phase error per step: −θ⁵/1920 of the quaternion, −θ⁵/120 of the matrix, and the remainder of each.
TEST_P(Textbook, Rk4PhaseErrorPerStep) {
  for (const double theta : {0.1, 0.2, 0.4}) {
    const double h = theta / turning.norm();
    const int n = 100;
    const auto phase_error = [&](Orientation orientation) {
      Motion run("rk4", sphere(turning), {orientation, GetParam(), false});
      run.steps(h, n);
      const Quaternion<double> exact = quaternion_from_rotation_vector<double>(n * h * turning);
      return rotation_vector(product(conjugate(exact), run.attitude())).dot(turning.normalized()) / n;
    };
    const double of_quaternion = phase_error(Orientation::quaternion), of_matrix = phase_error(Orientation::matrix);
    EXPECT_NEAR(of_quaternion, -std::pow(theta, 5) / 1920 + 2 * std::pow(theta / 2, 7) / 336,
                2e-16 + 5e-3 * std::pow(theta / 2, 9));
    EXPECT_NEAR(of_matrix, -std::pow(theta, 5) / 120 + std::pow(theta, 7) / 336, 2e-16 + 5e-3 * std::pow(theta, 9));
  }
}

// Explicit Euler: ΔE = (h²/2) Ω̇·JΩ̇ ≥ 0 and Δ|y|² = h²|ẏ|², exactly, at every step. Semi-implicit Euler does the
// same to the body rates: with Ω as the state it is explicit Euler.
TEST(ExplicitEuler, FeedsEulersEquations) {
  for (const Orientation orientation : {Orientation::quaternion, Orientation::matrix}) {
    const Formulation f{orientation, AngularState::velocity_body};
    Motion run("explicit_euler", hairer_vilmart(), f), semi("semi_implicit_euler", hairer_vilmart(), f);
    const double h = 0.05;
    for (int n = 0; n < 200; ++n) {
      const V3 rate = run.rate().segment<3>(run.slot().angular), spin = run.angular_state();
      const double energy = run.energy();
      run.steps(h, 1);
      semi.steps(h, 1);
      EXPECT_NEAR(run.energy() - energy, h * h / 2 * rate.dot(hairer_vilmart_moments.cwiseProduct(rate)),
                  4e-15 * energy);
      const double before = hairer_vilmart_moments.cwiseProduct(spin).squaredNorm();
      const double after = hairer_vilmart_moments.cwiseProduct(run.angular_state()).squaredNorm();
      EXPECT_NEAR(after - before, h * h * hairer_vilmart_moments.cwiseProduct(rate).squaredNorm(), 4e-15 * before);
      EXPECT_EQ(run.angular_state(), semi.angular_state());
    }
  }
}

// Hairer & Vilmart 2006, |Δy| at t = 10 with h = 0.05, body angular velocity as the state: to 1 %.
TEST(HairerVilmart, PublishedErrors) {
  const auto error = [](const char* method, const Formulation& f) {
    Motion run(method, hairer_vilmart(), f);
    run.steps(0.05, 200);
    return (hairer_vilmart_moments.cwiseProduct(run.angular_state()) - hairer_vilmart_end).norm();
  };
  for (const Formulation& f : {body_quaternion, body_matrix}) {
    EXPECT_NEAR(error("explicit_euler", f) / 2.471e-1, 1, 0.01);
    EXPECT_NEAR(error("rk4", f) / 4.275e-7, 1, 0.01);
  }
}

/// The least-squares slope of the energy against time, W, over t_end seconds.
double energy_drift(const char* method, const Formulation& f, double h, double t_end) {
  Motion run(method, hairer_vilmart(), f);
  const double start = run.energy();
  const auto n = std::int64_t(std::round(t_end / h));
  double st = 0, se = 0, stt = 0, ste = 0;
  for (std::int64_t k = 1; k <= n; ++k) {
    run.steps(h, 1);
    const double t = double(k) * h, e = run.energy() - start;
    st += t, se += e, stt += t * t, ste += t * e;
  }
  const double count = double(n);
  return (count * ste - st * se) / (count * stt - st * st);
}

// RK4 on the free top drifts secularly; with the world angular velocity as the state more, and upwards.
TEST(Rk4, SecularEnergyDrift) {
  for (const Formulation& f : {body_quaternion, body_matrix}) {
    EXPECT_NEAR(energy_drift("rk4", f, 0.1, 800) / -6.06e-8, 1, 0.03);
    EXPECT_NEAR(energy_drift("rk4", f, 0.05, 800) / -1.90e-9, 1, 0.03);
    EXPECT_NEAR(energy_drift("rk4", f, 0.025, 800) / -5.96e-11, 1, 0.03);
  }
  EXPECT_NEAR(energy_drift("rk4", world_quaternion, 0.1, 400) / 1.68e-6, 1, 0.03);
}

// Peters & Hsu: with the gyroscopic term left out ω is constant, so that the rotational energy is too, while the
// momentum goes round ω: max |H − H0|/|H0| = 0.0325276 at every step size. Energy alone does not show the missing term.
TEST(GyroscopicTermLeftOut, KeepsTheEnergyAndLosesTheMomentum) {
  Problem p = peters_hsu();
  p.forces.clear();
  p.starts[0].velocity.setZero();
  for (const char* method : {"explicit_euler", "semi_implicit_euler", "explicit_midpoint", "rk4"}) {
    for (const double h : {1e-3, 5e-4, 2e-4}) {
      Motion run(method, p, {Orientation::quaternion, AngularState::velocity_world, false});
      const double energy = run.energy();
      const V3 momentum = run.measure().angular_momentum;
      double worst_energy = 0, worst_momentum = 0;
      for (int k = 0; k < int(std::lround(10 / h)); ++k) {
        run.steps(h, 1);
        const Measurement<double> m = run.measure();
        worst_energy = std::max(worst_energy, std::abs(m.kinetic - energy) / energy);
        worst_momentum = std::max(worst_momentum, (m.angular_momentum - momentum).norm() / momentum.norm());
      }
      EXPECT_LT(worst_energy, 1e-12) << method;
      EXPECT_NEAR(worst_momentum, 0.0325276, 6e-8) << method << " at h = " << h;
    }
  }
}

// A constant torque about a principal axis: ω = ω0 + τt/I, of every method; the angle ω0 t + τt²/2I.
TEST(AxialTorque, SpinIsLinearInTime) {
  const double inertia = 0.8, torque = 0.4, spin = 0.7, h = 1e-3;
  Problem p;
  p.bodies.push_back({.name = "body", .inertia = laws::diagonal(0.5, inertia, 1.2)});
  p.starts.push_back({.angular_velocity = {0, spin, 0}});
  for (const char* frame : {"world", "body"}) {
    p.forces = {laws::force("constant_torque", {0}, {{"torque", V3(0, torque, 0)}, {"frame", std::string(frame)}})};
    for (const Formulation& f : gyroscopic_formulations()) {
      for (const char* method : {"explicit_euler", "semi_implicit_euler", "explicit_midpoint", "rk4"}) {
        Motion run(method, p, f);
        run.steps(h, 2000);
        const double t = 2, rate = spin + torque * t / inertia, angle = spin * t + torque * t * t / (2 * inertia);
        const std::string what = std::string(method) + ", " + label(f) + ", " + frame;
        // A matrix or a stored quaternion that has grown changes what the torque does, at the method's order.
        const bool exact = f.orientation == Orientation::quaternion && f.rotation_from == RotationFrom::normalized;
        const double order = method == std::string("rk4")                 ? 1e-11
                             : method == std::string("explicit_midpoint") ? 1e-5
                                                                          : 1e-2;
        EXPECT_NEAR(run.body().angular_velocity[1], rate, exact ? 1e-12 : order) << what;
        const V3 turned = rotation_vector(
            product(conjugate(quaternion_from_rotation_vector<double>(V3(0, angle, 0))), run.body().orientation));
        EXPECT_LT(turned.norm(), order) << what;
      }
    }
  }
}

// Peters & Hsu, complex case, exact state at t = 10: RK4 at h = 2e-4 reaches it to 1e-8 (rad, and relative in ω) in
// every formulation, normalized after each step. Left alone it does so too, but with the matrix and the world angular
// velocity, where the equations read R RᵀR: there the method itself is off by 2e-8, and by a sixteenth of that at half
// the step.
TEST(PetersHsu, EndStateInEveryFormulation) {
  const Quaternion<double> attitude(0.2251644204565, -0.6199276265891, -0.2770289703668, 0.6987457843377);
  const V3 spin(2.7558388762, -3.7359651567, -3.1618072245);
  for (const Formulation& f : gyroscopic_formulations()) {
    for (const bool project : {true, false}) {
      Motion run("rk4", peters_hsu(), f);
      const bool matrix_and_world =
          f.orientation == Orientation::matrix && f.angular_state == AngularState::velocity_world;
      const double h = matrix_and_world && !project ? 1e-4 : 2e-4;
      run.steps(h, std::lround(10 / h), project);
      const BodySnapshot<double> end = run.body();
      EXPECT_LT(angle_between(end.orientation, attitude), 1e-8) << label(f);
      EXPECT_LT((end.rotation.transpose() * end.angular_velocity - spin).norm(), 1e-8 * spin.norm()) << label(f);
      EXPECT_LT((run.position() - V3(-20, 20, 80 - 490)).norm(), 1e-8) << label(f);
    }
  }
}

}  // namespace
}  // namespace polhode::by_hand::rotation_closed_form_test
