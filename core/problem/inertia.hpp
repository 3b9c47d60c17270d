// SPDX-License-Identifier: BSD-3-Clause
// The inertia tensor: computed from point masses, moved between mass centre and another point, along its principal
// axes, in world axes, and tested for validity. Sources: the engine slides, "Computing the Inertia Tensor"; Goldstein,
// Poole & Safko, Classical Mechanics, 3rd ed., sections 5.3 and 5.4.
#pragma once

#include <span>
#include <string>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline core::inline problem {

struct PointMass {
  double mass = 0;                                     ///< kg
  Vector3<double> position = Vector3<double>::Zero();  ///< m
};

/// Total mass (kg).
double total_mass(std::span<const PointMass> points);

/// Centre of mass (m), in the frame of the positions. The total mass must not be zero.
Vector3<double> mass_center(std::span<const PointMass> points);

/// Inertia (kg m²) about the origin of the positions, in their axes: I_x = Σ m (y² + z²), … on the diagonal, −I_xy = −Σ
/// m x y, … off it (sign as in the slides).
Matrix3<double> inertia_of(std::span<const PointMass> points);

/// Parallel-axis theorem, I_point = I_centre + m (|d|² 1 − d dᵀ), kg m². d (m) is the vector between the point and the
/// mass centre; its sign does not matter.
Matrix3<double> inertia_about_point(const Matrix3<double>& inertia_about_center, double mass, const Vector3<double>& d);

/// Inverse of the parallel-axis theorem: I_centre = I_point − m (|d|² 1 − d dᵀ).
Matrix3<double> inertia_about_center(const Matrix3<double>& inertia_about_point, double mass, const Vector3<double>& d);

/// Principal moments and axes: I = A diag(moments) Aᵀ with A a rotation.
struct PrincipalAxes {
  Vector3<double> moments;  ///< principal moments, ascending, kg m²
  Matrix3<double> axes;     ///< columns: unit vectors in the axes of the tensor, right-handed
};

/// Principal axes of a symmetric matrix. The largest component of the first and of the second axis is positive, so that
/// a diagonal matrix with sorted entries has the coordinate axes.
PrincipalAxes principal_axes(const Matrix3<double>& inertia);

/// R I Rᵀ, kg m²: the inertia in world axes of a body with rotation R, body to world (course report, section 2.1).
/// R is taken as it is, orthonormal or not.
Matrix3<double> world_inertia(const Matrix3<double>& rotation, const Matrix3<double>& inertia_body);

/// R I⁻¹ Rᵀ, 1/(kg m²). It is the inverse of world_inertia only while R is orthonormal.
Matrix3<double> world_inverse_inertia(const Matrix3<double>& rotation, const Matrix3<double>& inertia_body);

/// Empty if the equations of motion are solvable with this inertia: finite, symmetric to 1e-9 of the largest element,
/// and positive definite. Otherwise the reason, in words that follow "the inertia …": "is not symmetric: …".
std::string equations_inertia_fault(const Matrix3<double>& inertia);

/// Empty if a body of positive density can have this inertia: the conditions above, and no principal moment larger than
/// the sum of the other two, to 1e-9 of the largest (equality: a flat body).
std::string inertia_fault(const Matrix3<double>& inertia);

}  // namespace polhode::core::problem
