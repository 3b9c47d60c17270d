// SPDX-License-Identifier: BSD-3-Clause
// Each formula is the integral of the slides' sums over a body of even density.
#include "collision/shapes/shape_inertia.hpp"

namespace polhode::inline collision::inline shapes {

namespace {

/// The moments (b² + c², a² + c², a² + b²) of half the inertia of a body whose second moments are a², b², c².
Vector3<double> perpendicular(const Vector3<double>& v) {
  const Vector3<double> s = v.cwiseAbs2();
  return {s[1] + s[2], s[0] + s[2], s[0] + s[1]};
}

}  // namespace

Vector3<double> sphere_moments(double mass, double radius) {
  return Vector3<double>::Constant(2 * mass * radius * radius / 5);
}

Vector3<double> box_moments(double mass, const Vector3<double>& size) { return mass / 12 * perpendicular(size); }

Vector3<double> cylinder_moments(double mass, double radius, double length) {
  const double across = mass * (3 * radius * radius + length * length) / 12;
  return {across, across, mass * radius * radius / 2};
}

// The cylindrical part has the share l/(l + 4r/3) of the mass. A half ball has its mass centre 3r/8 from its flat
// face: about the capsule's centre the two together have m (2r²/5 + l²/4 + 3rl/8).
Vector3<double> capsule_moments(double mass, double radius, double length) {
  const double r = radius, l = length;
  const double of_cylinder = mass * l / (l + 4 * r / 3), of_caps = mass - of_cylinder;
  const double across = of_caps * (2 * r * r / 5 + l * l / 4 + 3 * r * l / 8);
  return cylinder_moments(of_cylinder, r, l) + Vector3<double>(across, across, 2 * of_caps * r * r / 5);
}

Vector3<double> ellipsoid_moments(double mass, const Vector3<double>& semi_axes) {
  return mass / 5 * perpendicular(semi_axes);
}

}  // namespace polhode::collision::shapes
