// SPDX-License-Identifier: BSD-3-Clause
// The exact free top against 40-digit motions (free_top_reference.csv), published end points, and what any free motion
// must satisfy.
#include "core/exact/free_top.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace polhode::free_top_test {
namespace {

using Matrix = Matrix3<double>;
using Vector = Vector3<double>;
using Attitude = Quaternion<double>;

Matrix principal(double i1, double i2, double i3) { return Vector(i1, i2, i3).asDiagonal(); }

const Attitude turned(0.5, -0.1, 0.7, 0.5);

double distance(const FreeTop::Motion& a, const FreeTop::Motion& b) {
  return std::max((a.orientation - b.orientation).norm(),
                  (a.angular_velocity_body - b.angular_velocity_body).norm() / b.angular_velocity_body.norm());
}

struct TopCase {
  std::string name;
  Matrix inertia;
  Vector omega;
  std::string regime;
};

std::vector<TopCase> every_regime() {
  const Matrix full = (Matrix() << 2.0, 0.3, -0.4, 0.3, 3.0, 0.2, -0.4, 0.2, 2.5).finished();
  return {
      {"about the smallest", principal(0.6, 0.8, 1.0), {3, 0.5, -0.9}, "about the smallest axis"},
      {"about the smallest, backwards", principal(0.6, 0.8, 1.0), {-3, -0.5, -0.9}, "about the smallest axis"},
      {"about the largest", principal(1.0, 0.6, 0.8), {1.9, 0.8, 0.5}, "about the largest axis"},
      {"about the largest, backwards", principal(0.6, 0.8, 1.0), {0.8, 0.5, -1.9}, "about the largest axis"},
      {"full matrix", full, {0.7, -0.2, 1.1}, "about the smallest axis"},
      {"full matrix about the largest", full, {0.1, 1.2, 0.1}, "about the largest axis"},
      {"separatrix", principal(3, 4, 6), {2, 0.5, 1}, "separatrix"},
      {"separatrix, backwards", principal(4, 3, 6), {0.5, -2, -1}, "separatrix"},
      {"just inside", principal(3, 4, 6), {2 + 0x1p-40, 0.5, 1}, "about the smallest axis"},
      {"just outside", principal(3, 4, 6), {2 - 0x1p-40, 0.5, 1}, "about the largest axis"},
      {"near the intermediate axis", principal(3, 5, 9), {1e-9, 1, -1e-9}, "about the largest axis"},
      {"prolate", principal(3, 3, 1), {0.2, 1, -0.5}, "symmetric"},
      {"oblate", principal(2, 2, 3), {0.7, -0.3, 1.1}, "symmetric"},
      {"nearly oblate", principal(2, 2 + 1e-10, 3), {0.7, -0.3, 1.1}, "about the largest axis"},
      {"sphere", principal(1.5, 1.5, 1.5), {0.2, -1, 0.5}, "sphere"},
      {"sphere to round-off", principal(1, 1 + 0x1p-52, 1 + 0x1p-51), {0.2, -1, 0.5}, "sphere"},
      {"smallest axis", principal(0.6, 0.8, 1.0), {-1.1, 0, 0}, "pure spin"},
      {"intermediate axis", principal(0.6, 0.8, 1.0), {0, 1.1, 0}, "pure spin"},
      {"intermediate axis, full matrix", (Matrix() << 2, 1, 0, 1, 2, 0, 0, 0, 5).finished(), {1, 1, 0}, "pure spin"},
      {"largest axis", principal(0.6, 0.8, 1.0), {0, 0, 1.1}, "pure spin"},
      {"across a symmetric body", principal(3, 1, 3), {0.3, 0, 0.4}, "pure spin"},
  };
}

// True so near the separatrix that rounding its state gives a motion which soon departs from it.
bool is_delicate(const TopCase& c) {
  return c.regime == "separatrix" || c.name.starts_with("just") || c.name.starts_with("near the") ||
         c.name.starts_with("intermediate");
}

TEST(FreeTop, NamesItsRegime) {
  for (const TopCase& c : every_regime()) EXPECT_EQ(FreeTop(c.inertia, turned, c.omega).regime(), c.regime) << c.name;
  EXPECT_EQ(FreeTop(principal(1, 2, 3), turned, Vector::Zero()).regime(), "at rest");
}

// Every row to 2e-15 (1 + |ω| |t|), in every component and in the sign of the quaternion; measured: 5e-16.
TEST(FreeTop, AgreesWith40Digits) {
  const std::string path = POLHODE_TESTS_DIR "/core/exact/free_top_reference.csv";
  std::ifstream file(path);
  ASSERT_TRUE(file) << "cannot read " << path;
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.starts_with("case,")) continue;
    std::istringstream cells(line);
    std::string name, cell;
    std::getline(cells, name, ',');
    std::vector<double> x;
    while (std::getline(cells, cell, ',')) x.push_back(std::stod(cell));
    ASSERT_EQ(x.size(), 21u) << line;
    const Matrix inertia = (Matrix() << x[0], x[3], x[4], x[3], x[1], x[5], x[4], x[5], x[2]).finished();
    const Vector omega0(x[6], x[7], x[8]), omega(x[14], x[15], x[16]);
    const Attitude q0(x[9], x[10], x[11], x[12]), q(x[17], x[18], x[19], x[20]);
    const double t = x[13], speed = omega0.stableNorm(), tolerance = 2e-15 * (1 + speed * std::abs(t));
    const FreeTop::Motion motion = FreeTop(inertia, q0, omega0).at(t);
    EXPECT_LE((motion.angular_velocity_body - omega).stableNorm(), tolerance * speed) << name << " at t = " << t;
    EXPECT_LE((motion.orientation - q).norm(), tolerance) << name << " at t = " << t;
    ++rows;
  }
  EXPECT_GT(rows, 300);
}

TEST(FreeTop, StartsWhereItIsTold) {
  for (const TopCase& c : every_regime()) {
    EXPECT_LE(distance(FreeTop(c.inertia, turned, c.omega).at(0), {turned, c.omega}), 2e-15) << c.name;
  }
}

TEST(FreeTop, KeepsTheLengthOfTheQuaternion) {
  for (const TopCase& c : every_regime()) {
    const FreeTop::Motion unit = FreeTop(c.inertia, turned, c.omega).at(7);
    const FreeTop::Motion longer = FreeTop(c.inertia, 1.25 * turned, c.omega).at(7);
    EXPECT_LE(distance(longer, {1.25 * unit.orientation, unit.angular_velocity_body}), 2e-15) << c.name;
  }
}

TEST(FreeTop, StaysAtRest) {
  const FreeTop::Motion motion = FreeTop(principal(1, 2, 3), turned, Vector::Zero()).at(1e9);
  EXPECT_EQ(motion.orientation, turned);
  EXPECT_EQ(motion.angular_velocity_body, Vector::Zero());
}

TEST(FreeTop, ConservesEnergyAndWorldAngularMomentum) {
  for (const TopCase& c : every_regime()) {
    const FreeTop top(c.inertia, turned, c.omega);
    const double energy = c.omega.dot(c.inertia * c.omega) / 2;
    const Vector momentum = rotation_matrix(turned) * (c.inertia * c.omega);
    for (int k = -200; k <= 200; ++k) {
      const double t = 0.37 * k, tolerance = 2e-15 * (1 + c.omega.norm() * std::abs(t));
      const auto [q, omega] = top.at(t);
      EXPECT_NEAR(omega.dot(c.inertia * omega) / 2, energy, 1e-14 * energy) << c.name << " at t = " << t;
      EXPECT_LE((rotation_matrix(q) * (c.inertia * omega) - momentum).norm(), tolerance * momentum.norm())
          << c.name << " at t = " << t;
      EXPECT_NEAR(q.norm(), turned.norm(), 2e-15);
    }
  }
}

// q̇ = ½ q (0, ω) and I ω̇ = (I ω) × ω by central differences of order 8.
TEST(FreeTop, SatisfiesTheEquationsOfMotion) {
  for (const TopCase& c : every_regime()) {
    const FreeTop top(c.inertia, turned, c.omega);
    for (double t : {-31.0, -2.0, 0.0, 0.4, 1.7, 5.0, 23.0, 47.0}) {
      const double h = 0.02 / c.omega.norm(), weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
      Attitude q_dot = Attitude::Zero();
      Vector omega_dot = Vector::Zero();
      for (int k = 1; k <= 4; ++k) {
        const FreeTop::Motion ahead = top.at(t + k * h), behind = top.at(t - k * h);
        q_dot += weight[k - 1] / h * (ahead.orientation - behind.orientation);
        omega_dot += weight[k - 1] / h * (ahead.angular_velocity_body - behind.angular_velocity_body);
      }
      const auto [q, omega] = top.at(t);
      const double tolerance = 1e-12 * (1 + std::abs(t)) * omega.norm();
      EXPECT_LE((q_dot - product(q, pure(omega)) / 2).norm(), tolerance) << c.name << " at t = " << t;
      EXPECT_LE((c.inertia * omega_dot - (c.inertia * omega).cross(omega)).norm(), tolerance * 10 * omega.norm())
          << c.name << " at t = " << t;
    }
  }
}

TEST(FreeTop, GoesOnFromWhereItIs) {
  for (const TopCase& c : every_regime()) {
    const FreeTop top(c.inertia, turned, c.omega);
    const double there = 2.3, further = is_delicate(c) ? 3.1 : 40.0;
    const FreeTop::Motion middle = top.at(there);
    const FreeTop again(c.inertia, middle.orientation, middle.angular_velocity_body);
    EXPECT_LE(distance(again.at(further), top.at(there + further)), 3e-13) << c.name;
    EXPECT_LE(distance(again.at(-there), top.at(0)), 3e-13) << c.name;
  }
}

TEST(FreeTop, ComesBackFromFarAway) {
  const Matrix inertia = principal(0.6, 0.8, 1.0);
  const Vector omega(1.3, 0.4, 0.7);
  const FreeTop::Motion far = FreeTop(inertia, turned, omega).at(1e6);
  const FreeTop::Motion back = FreeTop(inertia, far.orientation, far.angular_velocity_body).at(-1e6);
  EXPECT_LE(distance(back, {turned, omega}), 2e-9);
}

// Relabelled or turned body axes r: I → r I rᵀ, ω → r ω, q → q r⁻¹, at every time.
TEST(FreeTop, DoesNotDependOnTheBodyAxes) {
  const double half = std::numbers::sqrt2 / 2;
  const std::vector<Attitude> exact = {{0.5, 0.5, 0.5, 0.5}, {0.5, -0.5, -0.5, -0.5}, {0, 0, 0, 1}, {0, 1, 0, 0}},
                              rounded = {{half, half, 0, 0}, {0.8, 0.48, -0.36, 0}, {0.1, -0.7, 0.1, 0.7}};
  for (const TopCase& c : every_regime()) {
    std::vector<Attitude> turns = exact;
    // rounding r I rᵀ moves a delicate motion to another one
    if (!is_delicate(c)) turns.insert(turns.end(), rounded.begin(), rounded.end());
    const FreeTop top(c.inertia, turned, c.omega);
    for (const Attitude& turn : turns) {
      const Matrix r = rotation_matrix(turn);
      const Attitude back = conjugate(turn) / turn.norm();
      const FreeTop other(r * c.inertia * r.transpose(), product(turned, back), r * c.omega);
      for (double t : {-12.0, 0.0, 0.9, 14.0, 60.0}) {
        const FreeTop::Motion motion = top.at(t);
        EXPECT_LE(distance(other.at(t), {product(motion.orientation, back), r * motion.angular_velocity_body}), 2e-13)
            << c.name << " at t = " << t;
      }
    }
  }
}

TEST(FreeTop, DoesNotDependOnTheUnits) {
  const Matrix inertia = principal(0.6, 0.8, 1.0);
  const Vector omega(1.3, 0.4, -0.7);
  for (double t : {0.3, 17.0}) {
    const FreeTop::Motion motion = FreeTop(inertia, turned, omega).at(t);
    for (int k : {-600, -30, 1, 40, 600}) {
      const double unit = std::ldexp(1.0, k);
      const FreeTop::Motion scaled = FreeTop(inertia * std::ldexp(1.0, k / 2), turned, omega * unit).at(t / unit);
      EXPECT_EQ(scaled.orientation, motion.orientation);
      EXPECT_EQ(scaled.angular_velocity_body, motion.angular_velocity_body * unit);
    }
  }
}

// The motion is a smooth function of its data: neighbours on the two sides of a border between regimes stay neighbours.
TEST(FreeTop, IsContinuousAcrossRegimes) {
  struct Border {
    const char* name;
    Matrix inertia, inertia_change;
    Vector omega, omega_change;
  };
  const Matrix none = Matrix::Zero();
  const std::vector<Border> borders = {
      {"separatrix", principal(3, 4, 6), none, {2, 0.5, 1}, {1, 0, 0}},
      {"separatrix, by the inertia", principal(3, 4, 6), principal(0, 1, 0), {-2, 0.5, 1}, Vector::Zero()},
      {"symmetric, oblate", principal(2, 2, 3), principal(0, 1, 0), {0.7, -0.3, 1.1}, Vector::Zero()},
      {"symmetric, prolate", principal(1, 3, 3), principal(0, 0, 1), {-0.2, 1, 0.5}, Vector::Zero()},
      {"sphere", principal(2, 2, 2), principal(0.2, 0.3, -1), {-0.2, 1, 0.5}, Vector::Zero()},
      {"smallest axis", principal(3, 4, 6), none, {1, 0, 0}, {0, 0.3, -0.7}},
      {"intermediate axis", principal(3, 4, 6), none, {0, -1, 0}, {0.6, 0, -0.7}},
      {"largest axis", principal(3, 4, 6), none, {0, 0, 1}, {0.3, -0.7, 0}},
  };
  for (const Border& b : borders) {
    const FreeTop on(b.inertia, turned, b.omega);
    for (double size : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
      for (double change : {size, -size}) {
        const FreeTop beside(b.inertia + change * b.inertia_change, turned, b.omega + change * b.omega_change);
        for (double t : {-3.0, 1.0, 4.0}) {
          EXPECT_LE(distance(beside.at(t), on.at(t)), 30 * size + 1e-14) << b.name << ' ' << change << " at t = " << t;
        }
      }
    }
  }
}

TEST(FreeTop, RefusesWhatIsNoTop) {
  const Vector omega(1, 2, 3);
  const Attitude q = identity_quaternion<double>();
  EXPECT_THROW(FreeTop(principal(1, 2, 0), q, omega), std::invalid_argument);
  EXPECT_THROW(FreeTop(principal(1, -2, 3), q, omega), std::invalid_argument);
  EXPECT_THROW(FreeTop((Matrix() << 1, 0.1, 0, 0, 1, 0, 0, 0, 1).finished(), q, omega), std::invalid_argument);
  EXPECT_THROW(FreeTop((Matrix() << 1, 2, 0, 2, 1, 0, 0, 0, 1).finished(), q, omega), std::invalid_argument);
  EXPECT_THROW(FreeTop(principal(1, 2, std::numeric_limits<double>::infinity()), q, omega), std::invalid_argument);
  EXPECT_THROW(FreeTop(principal(1, 2, 3), q, Vector(0, std::nan(""), 1)), std::invalid_argument);
}

// The published or independently computed end points, to the digits that are given.

TEST(FreeTop, PetersHsuComplexCase) {
  const auto [q, omega] =
      FreeTop(principal(0.80833333, 0.68333333, 0.14166667), identity_quaternion<double>(), {0.1, 5, 0.1}).at(10);
  EXPECT_LE(angle_between(q, {0.2251644204565, -0.6199276265891, -0.2770289703668, 0.6987457843377}), 5e-13);
  EXPECT_LE((omega - Vector(2.7558388762, -3.7359651567, -3.1618072245)).norm(), 1e-10);
}

TEST(FreeTop, HairerVilmart) {
  const Vector moments(0.6, 0.8, 1.0), y0(1.8, 0.4, -0.9);
  const auto [q, omega] =
      FreeTop(moments.asDiagonal(), identity_quaternion<double>(), y0.cwiseQuotient(moments)).at(10);
  const Vector y = moments.cwiseProduct(omega);
  EXPECT_LE((y - Vector(1.765962508518208, -0.695464197033089, 0.779554981481872)).norm(), 1e-14);
  EXPECT_LE(angle_between(q, {-0.736061364160794, -0.570786951240351, -0.299388571830790, -0.206839086104673}), 1e-14);
}

TEST(FreeTop, DetestB5) {
  const FreeTop top(principal(2, 3, 1), turned, {0, std::sqrt(0.51), std::sqrt(3.0)});
  const Vector scale(std::sqrt(1.53), std::sqrt(0.51), std::sqrt(3.0));
  const Vector exact(-0.939657079872920, -0.342117775400075, 0.741412659619995);
  EXPECT_LE((top.at(20).angular_velocity_body.cwiseQuotient(scale) - exact).norm(), 1e-14);
  EXPECT_LE((top.at(7.45056320933095).angular_velocity_body - top.at(0).angular_velocity_body).norm(), 2e-14);
}

// Q = Q0 exp(t y0/I) Rot(e3, s t), s = (I − J) ω3/I.
TEST(FreeTop, AxisymmetricCylinder) {
  const double i = 0.04, j = 0.02;
  const Vector omega0(2, 4, 6);
  const FreeTop top(principal(i, i, j), turned, omega0);
  for (double t : {0.1, 1.0, 10.0, -4.0}) {
    const double spin = (i - j) * omega0.z() / i * t;
    const Vector precession = Vector(omega0.x(), omega0.y(), j / i * omega0.z()) * t;
    const Attitude q = product(turned, product(quaternion_from_rotation_vector(precession),
                                               quaternion_from_rotation_vector(Vector(0, 0, spin))));
    const Vector omega(std::cos(spin) * 2 + std::sin(spin) * 4, std::cos(spin) * 4 - std::sin(spin) * 2, 6);
    EXPECT_LE(distance(top.at(t), {q, omega}), 1e-14 * (1 + std::abs(t))) << "t = " << t;
  }
}

TEST(FreeTop, DzhanibekovFlipsEveryHalfPeriod) {
  const double period = 118.110887046386;
  const Vector omega0(0, 2.0 / 5, 0.01 / 9);
  const FreeTop top(principal(3, 5, 9), turned, omega0);
  EXPECT_LE((top.at(period).angular_velocity_body - omega0).norm(), 1e-14);
  EXPECT_LE((top.at(period / 2).angular_velocity_body - Vector(0, -omega0.y(), omega0.z())).norm(), 1e-14);
}

// The elliptic functions below it.

TEST(Elliptic, CompleteIntegral) {
  EXPECT_DOUBLE_EQ(elliptic_k(1), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(elliptic_k(0.5), 1.8540746773013719184);  // Γ(1/4)²/4√π
  EXPECT_EQ(elliptic_k(0), std::numeric_limits<double>::infinity());
  for (double m_c : {1e-20, 1e-100, 1e-300}) EXPECT_DOUBLE_EQ(elliptic_k(m_c), std::log(4 / std::sqrt(m_c)));
}

TEST(Elliptic, SnCnDnInvertTheIncompleteIntegral) {
  for (double m_c : {1.0, 0.9, 0.5, 0.1, 1e-3, 1e-6, 1e-10, 1e-14, 1e-30, 0.0}) {
    const JacobiElliptic jacobi(m_c);
    for (double phi = -3.1; phi <= 3.1; phi += 0.05) {
      if (m_c == 0 && std::abs(phi) > 1.55) continue;
      const double u = elliptic_f(phi, m_c), tolerance = 2e-15 * (1 + std::abs(u));
      const auto [sn, cn, dn] = jacobi(u);
      EXPECT_NEAR(sn, std::sin(phi), tolerance) << m_c << ' ' << phi;
      EXPECT_NEAR(cn, std::cos(phi), tolerance) << m_c << ' ' << phi;
      EXPECT_NEAR(dn, std::sqrt(std::cos(phi) * std::cos(phi) + m_c * std::sin(phi) * std::sin(phi)), tolerance)
          << m_c << ' ' << phi;
      EXPECT_NEAR(elliptic_f(std::sin(phi), std::cos(phi), m_c), u, tolerance) << m_c << ' ' << phi;
    }
  }
}

// Near a quarter period the cosine carries the digits: F = K − cos φ/√m_c to first order.
TEST(Elliptic, IncompleteIntegralNearAQuarterPeriod) {
  const double m_c = 1e-14, cosine = 1e-18;
  EXPECT_NEAR(elliptic_k(m_c) - elliptic_f(1.0, cosine, m_c), cosine / std::sqrt(m_c), 3e-14);
  EXPECT_NEAR(elliptic_f(1.0, 1e-9, 0), std::log(2e9), 1e-14);
}

// ∫ du/(1 + c dn u) from a to b, by Simpson's rule, in which the constant is eliminated by one whole period.
TEST(Elliptic, ThetaCarriesTheIntegralOfTheThirdKind) {
  for (double m_c : {0.9, 0.3, 0.03, 0.029, 1e-3, 1e-6}) {
    const JacobiElliptic jacobi(m_c), complement(1 - m_c);
    const double k = jacobi.quarter_period();
    for (double part : {0.1, 0.5, 0.9}) {
      const double beta = part * complement.quarter_period();
      const auto at_beta = complement(beta);
      const double c = at_beta.cn / at_beta.dn, factor = 2 * c / std::sqrt((1 - c * c) * (1 - m_c * c * c));
      const ThetaDirection theta(1 - m_c, m_c, beta);
      const auto angle = [&](double u) {
        const auto [turn, re, im] = theta(u);
        return turn + std::atan2(im, re);
      };
      const auto integral = [&](double from, double to) {
        const int n = 4000;
        double sum = 0;
        for (int j = 0; j <= n; ++j) {
          const double weight = j == 0 || j == n ? 1 : j % 2 == 1 ? 4 : 2;
          sum += weight / (1 + c * jacobi(from + (to - from) * j / n).dn);
        }
        return sum * (to - from) / (3 * n);
      };
      const double mean = integral(-k, k) / (2 * k);
      for (double u : {0.1 * k, 0.4 * k, 0.8 * k, 1.3 * k}) {
        EXPECT_NEAR(integral(0, u), mean * u - factor * angle(u), 1e-10) << m_c << ' ' << part << ' ' << u / k;
      }
      EXPECT_NEAR(1 / (1 + c), mean - factor * theta.slope_at_zero(), 1e-10) << m_c << ' ' << part;
    }
  }
}

}  // namespace
}  // namespace polhode::free_top_test
