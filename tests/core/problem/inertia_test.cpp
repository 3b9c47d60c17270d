// SPDX-License-Identifier: BSD-3-Clause
// The inertia tensor against sums written out by hand, and its theorems on random bodies.
#include "core/problem/inertia.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/math/transform.hpp"

namespace polhode::inertia_test {
namespace {

using Vector = Vector3<double>;
using Matrix = Matrix3<double>;

Matrix diagonal(double a, double b, double c) { return Vector(a, b, c).asDiagonal(); }

void expect_near(const Matrix& a, const Matrix& b, double tolerance) {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance) << a << "\nis not\n" << b;
}

/// A fixed random body; `seed` picks it.
std::vector<PointMass> random_points(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> mass(0.1, 2), place(-1, 1);
  std::vector<PointMass> points(7);
  for (PointMass& p : points) p = {mass(random), Vector(place(random), place(random), place(random))};
  return points;
}

Matrix random_rotation(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return rotation_matrix<double>(Quaternion<double>(normal(random), normal(random), normal(random), normal(random)));
}

TEST(Inertia, PointMassesGiveTheSlidesSums) {
  // Σm y²+z² etc. by hand: 2 kg at (1, 2, 3) and 1 kg at (−1, 0, 1).
  const std::vector<PointMass> points = {{2, {1, 2, 3}}, {1, {-1, 0, 1}}};
  Matrix by_hand;
  by_hand << 2 * 13 + 1, -4, -(6 - 1),  //
      -4, 2 * 10 + 2, -12,              //
      -(6 - 1), -12, 2 * 5 + 1;
  expect_near(inertia_of(points), by_hand, 0);
  EXPECT_EQ(total_mass(points), 3);
  EXPECT_LE((mass_center(points) - Vector(1.0 / 3, 4.0 / 3, 7.0 / 3)).norm(), 1e-15);
}

TEST(Inertia, KineticEnergyOfTheSpinningPoints) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::vector<PointMass> points = random_points(seed);
    const Vector w(0.3, -1.1, 0.7);
    double energy = 0;
    for (const PointMass& p : points) energy += 0.5 * p.mass * w.cross(p.position).squaredNorm();
    EXPECT_NEAR(0.5 * w.dot(inertia_of(points) * w), energy, 1e-14 * energy);
  }
}

TEST(Inertia, ParallelAxisTheoremBothWays) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<PointMass> points = random_points(seed);
    const Vector center = mass_center(points);
    const double mass = total_mass(points);
    const Matrix about_origin = inertia_of(points);
    for (PointMass& p : points) p.position -= center;
    const Matrix about_center = inertia_of(points);
    expect_near(inertia_about_point(about_center, mass, center), about_origin, 1e-14);
    expect_near(inertia_about_point(about_center, mass, -center), about_origin, 1e-14);
    expect_near(inertia_about_center(about_origin, mass, center), about_center, 1e-14);
  }
}

TEST(Inertia, PrincipalAxesRebuildTheTensor) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const Matrix inertia = inertia_of(random_points(seed));
    const PrincipalAxes p = principal_axes(inertia);
    EXPECT_LE(p.moments[0], p.moments[1]);
    EXPECT_LE(p.moments[1], p.moments[2]);
    EXPECT_NEAR(p.axes.determinant(), 1, 1e-14);
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(p.axes.col(i).maxCoeff(), p.axes.col(i).cwiseAbs().maxCoeff()) << "the sign of axis " << i;
    }
    expect_near(p.axes.transpose() * p.axes, Matrix::Identity(), 1e-14);
    expect_near(p.axes * p.moments.asDiagonal() * p.axes.transpose(), inertia, 1e-13);
  }
}

TEST(Inertia, PrincipalAxesOfDiagonalTensors) {
  expect_near(principal_axes(diagonal(1, 2, 3)).axes, Matrix::Identity(), 0);
  const PrincipalAxes p = principal_axes(diagonal(3, 2, 1));
  EXPECT_EQ(p.moments, Vector(1, 2, 3));
  EXPECT_EQ(p.axes.col(0), Vector(0, 0, 1));
  EXPECT_EQ(p.axes.col(1), Vector(0, 1, 0));
  EXPECT_EQ(p.axes.col(2), Vector(-1, 0, 0));
}

TEST(Inertia, WorldInertiaIsThatOfTheTurnedPoints) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<PointMass> points = random_points(seed);
    const Matrix body = inertia_of(points), r = random_rotation(seed);
    for (PointMass& p : points) p.position = r * p.position;
    const Matrix world = world_inertia(r, body);
    expect_near(world, inertia_of(points), 1e-13);
    expect_near(world_inverse_inertia(r, body) * world, Matrix::Identity(), 1e-12);
  }
}

TEST(Inertia, WorldInertiaTakesTheMatrixAsItIs) {
  const Matrix stretched = 2 * Matrix::Identity();
  expect_near(world_inertia(stretched, diagonal(1, 2, 2)), diagonal(4, 8, 8), 0);
  expect_near(world_inverse_inertia(stretched, diagonal(1, 2, 2)), diagonal(4, 2, 2), 0);
}

TEST(Inertia, RealBodiesPass) {
  EXPECT_EQ(inertia_fault(diagonal(1, 1, 1)), "");
  EXPECT_EQ(inertia_fault(diagonal(1, 2, 3)), "") << "a flat body";
  EXPECT_EQ(inertia_fault(diagonal(0.1, 0.2, 0.3)), "") << "a flat body, to round-off";
  EXPECT_EQ(inertia_fault(diagonal(1e-12, 1, 1)), "") << "a needle";
  EXPECT_EQ(inertia_fault(diagonal(1e-200, 1e-200, 1e-200)), "");
  EXPECT_EQ(inertia_fault(diagonal(1e200, 1e200, 1e200)), "");
  for (unsigned seed = 1; seed <= 50; ++seed) EXPECT_EQ(inertia_fault(inertia_of(random_points(seed))), "");
}

TEST(Inertia, TriangleInequalityTo1e9) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    EXPECT_EQ(inertia_fault(size * diagonal(1, 2, 3 * (1 + 0.9e-9))), "");
    EXPECT_NE(inertia_fault(size * diagonal(1, 2, 3 * (1 + 1.1e-9))), "");
    const Matrix r = random_rotation(5);
    EXPECT_NE(inertia_fault(size * (r * diagonal(1, 2, 3.1) * r.transpose())), "") << "off the principal axes";
  }
  EXPECT_NE(inertia_fault(diagonal(3, 5, 9)).find("triangle"), std::string::npos);
  EXPECT_NE(inertia_fault(diagonal(9, 3, 5)).find("(3, 5, 9)"), std::string::npos) << "names the moments";
  EXPECT_EQ(equations_inertia_fault(diagonal(3, 5, 9)), "") << "the equations do not mind";
}

TEST(Inertia, AsymmetricTensorsFail) {
  Matrix m = diagonal(2, 2, 2);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    m(i, j) = 1e-3;
    EXPECT_NE(inertia_fault(m).find("not symmetric"), std::string::npos);
    m(j, i) = 1e-3;
    EXPECT_EQ(inertia_fault(m), "");
  }
  m(0, 1) += 1e-9;
  EXPECT_EQ(inertia_fault(m), "") << "round-off of printing";
}

TEST(Inertia, TensorsThatAreNotPositiveFail) {
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(inertia_fault(diagonal(0, 1, 1)).find("not positive"), std::string::npos);
  EXPECT_NE(inertia_fault(diagonal(1, -1, 1)).find("not positive"), std::string::npos);
  EXPECT_NE(inertia_fault(diagonal(1e-320, 1e-320, 1e-320)), "") << "its inverse would overflow";
  EXPECT_EQ(inertia_fault(diagonal(1, inf, 1)), "is not finite");
  EXPECT_EQ(inertia_fault(diagonal(1, 1, nan)), "is not finite");
  Matrix rod = inertia_of(std::vector<PointMass>{{1, {1, 2, 3}}, {1, {-1, -2, -3}}});
  EXPECT_NE(inertia_fault(rod).find("not positive"), std::string::npos) << "two points have no moment about their line";
  Matrix off;  // positive on the diagonal only
  off << 1, 2, 0, 2, 1, 0, 0, 0, 1;
  EXPECT_NE(inertia_fault(off).find("not positive"), std::string::npos);
}

TEST(Transform, TakesPointsFromBodyToWorld) {
  // A quarter turn about z takes the body's x axis to the world's y axis; the slides' printed block would take it to
  // −y.
  const Quaternion<double> q(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
  const Matrix4<double> m = body_to_world<double>(Vector(10, 20, 30), q);
  EXPECT_LE((transform_point<double>(m, Vector(1, 0, 0)) - Vector(10, 21, 30)).norm(), 1e-14);
  EXPECT_EQ(m.row(3), Eigen::RowVector4d(0, 0, 0, 1));
  expect_near(m.topLeftCorner<3, 3>(), rotation_matrix(q), 0);
}

}  // namespace
}  // namespace polhode::inertia_test
