// SPDX-License-Identifier: BSD-3-Clause
// Lagrange's top and the pendulum against 40-digit motions (lagrange_top_reference.csv), a published motion, and what
// any such motion must satisfy.
#include "core/exact/lagrange_top.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace polhode::lagrange_top_test {
namespace {

using Matrix = Matrix3<double>;
using Vector = Vector3<double>;
using Attitude = Quaternion<double>;

struct Row {
  std::string name;
  double mass, t;
  Matrix inertia;
  Vector center, gravity, omega0, omega;
  Attitude q0, q;

  LagrangeTop top() const { return {mass, inertia, center, gravity, q0, omega0}; }
  double least_moment() const { return inertia.diagonal().minCoeff(); }
  /// Bound of the fastest change: the rate at the start, and what the fall of the mass centre can add, rad/s.
  double rate() const { return omega0.norm() + 2 * std::sqrt(mass * gravity.norm() * center.norm() / least_moment()); }
};

std::vector<Row> reference_rows() {
  std::ifstream file(POLHODE_TESTS_DIR "/core/exact/lagrange_top_reference.csv");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.starts_with("case,")) continue;
    std::istringstream cells(line);
    Row row;
    std::string cell;
    std::getline(cells, row.name, ',');
    std::vector<double> x;
    while (std::getline(cells, cell, ',')) x.push_back(std::stod(cell));
    if (x.size() != 28) throw std::runtime_error("a row of " + std::to_string(x.size()) + " numbers: " + line);
    row.mass = x[0];
    row.inertia << x[1], x[4], x[5], x[4], x[2], x[6], x[5], x[6], x[3];
    const auto vector = [&](std::size_t i) { return Vector(x[i], x[i + 1], x[i + 2]); };
    row.center = vector(7);
    row.gravity = vector(10);
    row.q0 = {x[13], x[14], x[15], x[16]};
    row.omega0 = vector(17);
    row.t = x[20];
    row.omega = vector(21);
    row.q = {x[24], x[25], x[26], x[27]};
    rows.push_back(row);
  }
  return rows;
}

TEST(LagrangeTop, AgreesWith40Digits) {
  const auto rows = reference_rows();
  ASSERT_GT(rows.size(), 150u);
  for (const Row& row : rows) {
    const LagrangeTop::Motion motion = row.top().at(row.t);
    const double tolerance = 4e-15 * (1 + row.rate() * std::abs(row.t));
    EXPECT_LE((motion.orientation - row.q).norm(), tolerance) << row.name << " at t = " << row.t;
    EXPECT_LE((motion.angular_velocity_body - row.omega).norm(), tolerance * row.rate())
        << row.name << " at t = " << row.t;
  }
}

TEST(LagrangeTop, StartsWhereItIsTold) {
  for (const Row& row : reference_rows()) {
    const LagrangeTop::Motion motion = row.top().at(0);
    EXPECT_LE((motion.orientation - row.q0.normalized()).norm(), 2e-15) << row.name;
    EXPECT_LE((motion.angular_velocity_body - row.omega0).norm(), 4e-15 * row.rate()) << row.name;
  }
}

TEST(LagrangeTop, ConservesItsMomentaAndItsEnergy) {
  for (const Row& row : reference_rows()) {
    const LagrangeTop top = row.top();
    const auto invariants = [&](const LagrangeTop::Motion& m) {
      const Vector y = row.inertia * m.angular_velocity_body;
      const Vector down = rotation_matrix(m.orientation).transpose() * row.gravity;
      return Vector(m.angular_velocity_body.dot(y) / 2 - row.mass * down.dot(row.center),
                    y.dot(down) / row.gravity.norm(), y.dot(row.center) / row.center.norm());
    };
    const double momentum = row.inertia.trace() * row.rate();
    const Vector start = invariants(top.at(0)), scale(momentum * row.rate(), momentum, momentum);
    for (int k = -50; k <= 50; ++k) {
      EXPECT_LE((invariants(top.at(1.3 * k)) - start).cwiseQuotient(scale).norm(), 1e-13) << row.name << ' ' << k;
    }
  }
}

// A motion that is not delicate goes on in the same way if it starts again in its midst.
TEST(LagrangeTop, GoesOnFromWhereItIs) {
  for (const Row& row : reference_rows()) {
    if (row.name.starts_with("sleeping 2") || row.name.starts_with("pendulum near")) continue;
    if (row.inertia(0, 0) != row.inertia(1, 1) && row.center.x() == 0) continue;  // rounding tilts the plane of a swing
    const LagrangeTop top = row.top();
    const LagrangeTop::Motion there = top.at(2.3), end = top.at(7.4);
    const LagrangeTop::Motion again =
        LagrangeTop(row.mass, row.inertia, row.center, row.gravity, there.orientation, there.angular_velocity_body)
            .at(5.1);
    EXPECT_LE((again.orientation - end.orientation).norm(), 1e-12 * (1 + row.rate())) << row.name;
  }
}

// Simo & Wong 1991, computed independently: nutation and the axis at t = 10.
TEST(LagrangeTop, SimoWong) {
  const LagrangeTop top(1, Vector(5, 5, 1).asDiagonal(), {0, 0, 2}, {0, 0, -10},
                        quaternion_from_rotation_vector(Vector(0.05, 0, 0)), {0, 0, 50});
  EXPECT_NEAR(top.lowest_cosine(), 0.998512425506, 1e-12);
  EXPECT_NEAR(top.highest_cosine(), 0.998750260395, 1e-12);
  const Vector axis = rotation_matrix(top.at(10).orientation).col(2);
  EXPECT_LE((axis - Vector(-0.047132231442, 0.026748686359, 0.998530450481)).norm(), 1e-11);
}

// Upright, hanging and at rest: ω is constant, whether the motion is stable or not.
TEST(LagrangeTop, SleepsUprightAndHanging) {
  for (const Attitude& q : {Attitude(1, 0, 0, 0), Attitude(0, 1, 0, 0)}) {
    for (const double spin : {0.0, 3.0, -40.0}) {
      const Vector omega(0, 0, spin);
      const LagrangeTop top(1, Vector(0.3, 0.3, 0.1).asDiagonal(), {0, 0, 0.5}, {0, 0, -9.81}, q, omega);
      const LagrangeTop::Motion motion = top.at(7);
      EXPECT_LE((motion.angular_velocity_body - omega).norm(), 1e-15);
      EXPECT_LE((motion.orientation - product(q, quaternion_from_rotation_vector(Vector(7 * omega)))).norm(), 1e-13);
    }
  }
}

// The period 4 K(sin θ0/2)/ω0 of the pendulum; K(sin ½) = 1.6800 by its series is not used: K comes from elliptic_k.
TEST(LagrangeTop, PendulumPeriod) {
  const double i = 0.3334, w0 = std::sqrt(9.81 * 0.5 / i), s = std::sin(0.5);
  const double period = 4 * elliptic_k(1 - s * s) / w0;
  const Attitude q(std::cos(0.5), std::sin(0.5), 0, 0);
  const LagrangeTop top(1, Vector(i, 0.31, 0.1).asDiagonal(), {0, 0, -0.5}, {0, 0, -9.81}, q, Vector::Zero());
  EXPECT_LE((top.at(period).orientation - q).norm(), 1e-14);
  EXPECT_LE((top.at(period / 2).orientation - conjugate(q)).norm(), 1e-14);
  EXPECT_NEAR(top.at(period / 4).angular_velocity_body.x(), -2 * w0 * s, 1e-13);
}

TEST(LagrangeTop, RefusesOtherTops) {
  const Vector g(0, 0, -9.81), arm(0, 0, 0.5);
  const Attitude q(0.5, -0.1, 0.7, 0.5), level(1, 0, 0, 0);
  const auto applies = [](const Vector& moments, const Vector& c, const Vector& gravity, const Attitude& start,
                          const Vector& omega) {
    return LagrangeTop::applies(moments.asDiagonal(), c, gravity, start, omega);
  };
  EXPECT_TRUE(applies({3, 3, 1}, arm, g, q, {1, 2, 3}));
  EXPECT_FALSE(applies({3, 3.0001, 1}, arm, g, q, {1, 2, 3}));
  EXPECT_FALSE(applies({2, 2, 1}, {0.5, 0, 0}, g, q, {1, 2, 3}));  // Kovalevskaya's
  EXPECT_FALSE(applies({3, 3, 1}, {0, 1e-9, 0.5}, g, q, {1, 2, 3}));
  EXPECT_FALSE(applies({3, 3, 1}, Vector::Zero(), g, q, {1, 2, 3}));
  EXPECT_FALSE(applies({3, 3, 1}, arm, Vector::Zero(), q, {1, 2, 3}));
  EXPECT_TRUE(applies({1, 2, 2.5}, arm, g, level, {1, 0, 0}));
  EXPECT_FALSE(applies({1, 2, 2.5}, arm, g, level, {1, 1e-6, 0}));
  EXPECT_FALSE(applies({1, 2, 2.5}, arm, g, q, {1, 0, 0}));                 // the axis is not level
  EXPECT_FALSE(applies({1, 2, 2.5}, {0.01, 0, 0.5}, g, level, {1, 0, 0}));  // the mass centre is off the plane
  EXPECT_THROW(LagrangeTop(1, Vector(3, 2, 1).asDiagonal(), arm, g, q, {1, 2, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace polhode::lagrange_top_test
