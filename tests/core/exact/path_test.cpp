// SPDX-License-Identifier: BSD-3-Clause
// Kepler's motion and the linear oscillator against 40 digits (path_reference.py), and what no table says.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/exact/kepler_motion.hpp"
#include "core/exact/linear_motion.hpp"

namespace polhode::path_test {
namespace {

using Vector = Vector3<double>;

struct Line {
  std::string name;
  std::vector<double> x;
  Vector vector(std::size_t i) const { return {x[i], x[i + 1], x[i + 2]}; }
};

/// The numbers of a table; named: the first cell is a text.
std::vector<Line> table(const std::string& file, bool named, std::size_t size) {
  std::ifstream in(POLHODE_TESTS_DIR "/core/exact/" + file);
  std::vector<Line> lines;
  bool header = true;
  for (std::string text; std::getline(in, text);) {
    if (text.starts_with('#')) continue;
    if (std::exchange(header, false)) continue;
    std::istringstream cells(text);
    Line line;
    if (named) std::getline(cells, line.name, ',');
    for (std::string cell; std::getline(cells, cell, ',');)
      line.x.push_back(std::strtod(cell.c_str(), nullptr));  // 0 where doubles end
    if (line.x.size() != size) throw std::runtime_error("not " + std::to_string(size) + " numbers: " + text);
    lines.push_back(line);
  }
  return lines;
}

TEST(KeplerMotion, AgreesWith40Digits) {
  const auto lines = table("kepler_motion_reference.csv", true, 14);
  ASSERT_GT(lines.size(), 90u);
  for (const Line& line : lines) {
    const double mu = line.x[0], t = line.x[7];
    const Vector r0 = line.vector(1), v0 = line.vector(4), r = line.vector(8), v = line.vector(11);
    const KeplerMotion::Motion m = KeplerMotion(mu, r0, v0).at(t);
    // the angle runs fastest at the pericentre
    const double q = r0.cross(v0).squaredNorm() / mu / 2,
                 rate = std::sqrt(mu / std::pow(std::max(q, 1e-3 * r0.norm()), 3));
    const double tolerance = 1e-15 * (1 + rate * std::abs(t));
    EXPECT_LE((m.position - r).norm(), tolerance * std::max(r.norm(), r0.norm())) << line.name << " at t = " << t;
    EXPECT_LE((m.velocity - v).norm(), tolerance * std::max(v.norm(), v0.norm())) << line.name << " at t = " << t;
  }
}

TEST(KeplerMotion, StartsWhereItIsTold) {
  for (const Line& line : table("kepler_motion_reference.csv", true, 14)) {
    const Vector r0 = line.vector(1), v0 = line.vector(4);
    const KeplerMotion::Motion m = KeplerMotion(line.x[0], r0, v0).at(0);
    EXPECT_LE((m.position - r0).norm(), 4e-16 * r0.norm()) << line.name;
    EXPECT_LE((m.velocity - v0).norm(), 4e-16 * v0.norm()) << line.name;
  }
}

TEST(KeplerMotion, ComesBackAfterAMillionPeriods) {
  const Vector r0(1, 0.2, -0.3), v0(0.1, 0.9, 0.4);
  const KeplerMotion motion(1, r0, v0);
  EXPECT_LE((motion.at(1e6 * motion.period()).position - r0).norm(), 2e-9);
  EXPECT_TRUE(std::isinf(KeplerMotion(1, r0, 2 * v0).period()));
}

// Let go at rest, the bodies meet after π/√8 (μ = 1, distance 1), bounce, and are back after twice that.
TEST(KeplerMotion, FallsOnALineAndBounces) {
  const KeplerMotion motion(1, {1, 0, 0}, Vector::Zero());
  const double fall = std::numbers::pi / std::sqrt(8.0);
  EXPECT_LE(motion.at(fall).position.norm(), 1e-9);
  EXPECT_LE((motion.at(2 * fall).position - Vector(1, 0, 0)).norm(), 1e-14);
  EXPECT_NEAR(motion.eccentricity(), 1, 1e-15);
}

// Orbits so close to the parabola, and so far out, that the angle of a hyperbola would overflow.
TEST(KeplerMotion, FliesAnyDistance) {
  const Vector v(3, 0, 0);
  EXPECT_LE((KeplerMotion(1e-6, {0, 1, 0}, v).at(1e12).velocity - v).norm(), 1e-5);
  EXPECT_TRUE(KeplerMotion(1, {0, 1, 0}, {std::sqrt(2.0), 0, 0}).at(1e15).position.allFinite());
}

TEST(KeplerMotion, RefusesNonsense) {
  EXPECT_THROW(KeplerMotion(0, {1, 0, 0}, {0, 1, 0}), std::invalid_argument);
  EXPECT_THROW(KeplerMotion(-1, {1, 0, 0}, {0, 1, 0}), std::invalid_argument);
  EXPECT_THROW(KeplerMotion(1, {0, 0, 0}, {0, 1, 0}), std::invalid_argument);
  EXPECT_THROW(KeplerMotion(1, {1, 0, std::nan("")}, {0, 1, 0}), std::invalid_argument);
}

TEST(LinearMotion, AgreesWith40Digits) {
  const auto lines = table("linear_motion_reference.csv", false, 6);
  ASSERT_GT(lines.size(), 250u);
  for (const Line& line : lines) {
    const double t = line.x[2], rate = std::sqrt(line.x[0]) + line.x[1] / 2;
    const LinearMotion::Response r = LinearMotion(line.x[0], line.x[1]).at(t);
    const double tolerance = 2e-15 * (1 + rate * t);
    const auto what = ::testing::Message() << "w2 = " << line.x[0] << ", 2 gamma = " << line.x[1] << ", t = " << t;
    EXPECT_NEAR(r.by_velocity, line.x[3], tolerance * std::min(t, 1 / rate)) << what;
    EXPECT_NEAR(r.by_acceleration, line.x[4], tolerance * std::min(t * t, std::abs(line.x[4]))) << what;
    EXPECT_NEAR(r.rate_by_velocity, line.x[5], tolerance) << what;
  }
}

}  // namespace
}  // namespace polhode::path_test
