// SPDX-License-Identifier: BSD-3-Clause
// Moments of inertia of simple shapes (kg m²) about their mass centre, in their own axes, from mass (kg) and sizes (m).
#pragma once

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision::inline shapes {

// Principal moments about the mass centre; the axis of a cylinder or capsule is body axis 3, and the length of a
// capsule that of its cylindrical part.
Vector3<double> sphere_moments(double mass, double radius);
Vector3<double> box_moments(double mass, const Vector3<double>& size);  ///< size: full edge lengths
Vector3<double> cylinder_moments(double mass, double radius, double length);
Vector3<double> capsule_moments(double mass, double radius, double length);
Vector3<double> ellipsoid_moments(double mass, const Vector3<double>& semi_axes);

}  // namespace polhode::collision::shapes
