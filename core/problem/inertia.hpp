// SPDX-License-Identifier: BSD-3-Clause
// The inertia tensor: from point masses, moved from the mass centre to another point and back, along its principal
// axes, in world axes, and the test whether a matrix can be one at all.
// Sources: the engine slides, "Computing the Inertia Tensor"; Goldstein, Poole & Safko, Classical Mechanics, 3rd ed.,
// sections 5.3 and 5.4.
#pragma once

#include <span>
#include <string>

#include "core/math/linear_algebra.hpp"

namespace polhode {

struct PointMass {
  double mass = 0;                                     ///< kg
  Vector3<double> position = Vector3<double>::Zero();  ///< m
};

/// kg.
double total_mass(std::span<const PointMass> points);

/// m, in the frame of the positions. The total mass must not be zero.
Vector3<double> mass_center(std::span<const PointMass> points);

/// kg m², about the origin of the positions, in their axes: I_x = Σ m (y² + z²), … on the diagonal and the products
/// I_xy = Σ m x y, … off it with a minus sign, as the slides have them.
Matrix3<double> inertia_of(std::span<const PointMass> points);

/// Parallel-axis theorem, I_point = I_centre + m (|d|² 1 − d dᵀ), kg m². d (m) leads from the point to the mass centre
/// or back: only its square counts.
Matrix3<double> inertia_about_point(const Matrix3<double>& inertia_about_center, double mass, const Vector3<double>& d);

/// The same read backwards: I_centre = I_point − m (|d|² 1 − d dᵀ).
Matrix3<double> inertia_about_center(const Matrix3<double>& inertia_about_point, double mass, const Vector3<double>& d);

/// I = A diag(moments) Aᵀ with A a rotation.
struct PrincipalAxes {
  Vector3<double> moments;  ///< kg m², ascending
  Matrix3<double> axes;     ///< columns: unit vectors in the axes of the tensor, right-handed
};

/// Of a symmetric matrix. The largest component of the first and of the second axis is positive, so that the axes of a
/// diagonal matrix that is sorted already are the coordinate axes.
PrincipalAxes principal_axes(const Matrix3<double>& inertia);

/// R I Rᵀ, kg m²: the inertia in world axes of a body with rotation R, body to world (course report, section 2.1).
/// R is taken as it is, orthonormal or not.
Matrix3<double> world_inertia(const Matrix3<double>& rotation, const Matrix3<double>& inertia_body);

/// R I⁻¹ Rᵀ, 1/(kg m²). It is the inverse of world_inertia only while R is orthonormal.
Matrix3<double> world_inverse_inertia(const Matrix3<double>& rotation, const Matrix3<double>& inertia_body);

/// Empty if the equations of motion make sense with this inertia: finite, symmetric to 1e-9 of the largest element,
/// and positive definite. Otherwise the reason, in words that follow "the inertia …": "is not symmetric: …".
std::string equations_inertia_fault(const Matrix3<double>& inertia);

/// Empty if some body has this inertia: the same, and no principal moment above the sum of the other two, to 1e-9 of
/// the largest (equal: a flat body).
std::string inertia_fault(const Matrix3<double>& inertia);

}  // namespace polhode
