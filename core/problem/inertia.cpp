// SPDX-License-Identifier: BSD-3-Clause
#include "core/problem/inertia.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace polhode::inline core::inline problem {

namespace {

constexpr double tolerance = 1e-9;

/// Inertia tensor of a point mass (kg) at d (m): m (|d|² 1 − d dᵀ), kg m².
Matrix3<double> point_inertia(double mass, const Vector3<double>& d) {
  return mass * (d.squaredNorm() * Matrix3<double>::Identity() - d * d.transpose());
}

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", x);
  return buffer;
}

std::string text(const Vector3<double>& v) { return "(" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + ")"; }

/// Principal moments in ascending order, kg m². For a diagonal matrix they are its diagonal entries,
/// free of the round-off of an eigenvalue solver.
Vector3<double> principal_moments(const Matrix3<double>& inertia) {
  if (!inertia.isDiagonal(0)) return principal_axes(inertia).moments;
  Vector3<double> moments = inertia.diagonal();
  std::sort(moments.begin(), moments.end());
  return moments;
}

}  // namespace

double total_mass(std::span<const PointMass> points) {
  double mass = 0;
  for (const PointMass& p : points) mass += p.mass;
  return mass;
}

Vector3<double> mass_center(std::span<const PointMass> points) {
  Vector3<double> moment = Vector3<double>::Zero();
  for (const PointMass& p : points) moment += p.mass * p.position;
  return moment / total_mass(points);
}

Matrix3<double> inertia_of(std::span<const PointMass> points) {
  Matrix3<double> inertia = Matrix3<double>::Zero();
  for (const PointMass& p : points) {
    const double m = p.mass, x = p.position[0], y = p.position[1], z = p.position[2];
    Matrix3<double> one;
    one << m * (y * y + z * z), -m * x * y, -m * x * z,  //
        -m * x * y, m * (x * x + z * z), -m * y * z,     //
        -m * x * z, -m * y * z, m * (x * x + y * y);
    inertia += one;
  }
  return inertia;
}

Matrix3<double> inertia_about_point(const Matrix3<double>& about_center, double mass, const Vector3<double>& d) {
  return about_center + point_inertia(mass, d);
}

Matrix3<double> inertia_about_center(const Matrix3<double>& about_point, double mass, const Vector3<double>& d) {
  return about_point - point_inertia(mass, d);
}

PrincipalAxes principal_axes(const Matrix3<double>& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3<double>> solver(inertia);
  PrincipalAxes result{solver.eigenvalues(), solver.eigenvectors()};
  for (int i = 0; i < 2; ++i) {
    auto axis = result.axes.col(i);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis[largest] < 0) axis = -axis;
  }
  result.axes.col(2) = Vector3<double>(result.axes.col(0).cross(result.axes.col(1)));
  return result;
}

Matrix3<double> world_inertia(const Matrix3<double>& rotation, const Matrix3<double>& inertia_body) {
  return rotation * inertia_body * rotation.transpose();
}

Matrix3<double> world_inverse_inertia(const Matrix3<double>& rotation, const Matrix3<double>& inertia_body) {
  return rotation * inertia_body.inverse() * rotation.transpose();
}

std::string equations_inertia_fault(const Matrix3<double>& inertia) {
  if (!inertia.allFinite()) return "is not finite";
  const double size = inertia.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (std::abs(inertia(i, j) - inertia(j, i)) <= tolerance * size) continue;
    return "is not symmetric: " + text(inertia(i, j)) + " faces " + text(inertia(j, i));
  }
  const Vector3<double> moments = principal_moments(inertia);
  // The eigenvalues of a non-diagonal matrix have an error proportional to its size.
  const double noise = inertia.isDiagonal(0) ? 0 : 8 * std::numeric_limits<double>::epsilon() * size;
  if (!(moments[0] > noise) || !std::isfinite(1 / moments[0])) {
    return "is not positive: its principal moments are " + text(moments) + " kg m^2";
  }
  return "";
}

std::string inertia_fault(const Matrix3<double>& inertia) {
  if (std::string fault = equations_inertia_fault(inertia); !fault.empty()) return fault;
  const Vector3<double> moments = principal_moments(inertia);
  if (!(moments[0] + moments[1] >= (1 - tolerance) * moments[2])) {
    return "breaks the triangle inequality: no body has the principal moments " + text(moments) +
           " kg m^2, the largest of which is more than the sum of the others";
  }
  return "";
}

}  // namespace polhode::core::problem
