// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/ellipsoid.hpp"

#include <numbers>

#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

Ellipsoid::Ellipsoid(const Vector3<double>& semi_axes)
    : Shape(ShapeTag::ellipsoid), semi_axes_(positive_sizes("ellipsoid", "semi_axes", semi_axes)) {}

// The image S u of the unit ball's point u = S d/|S d|.
Vector3<double> Ellipsoid::support(const Vector3<double>& d) const {
  return semi_axes_.cwiseProduct(semi_axes_.cwiseProduct(d.stableNormalized()).stableNormalized());
}

Bounds Ellipsoid::bounds(const Pose& pose) const {
  const Vector3<double> half = (pose.rotation * semi_axes_.asDiagonal()).rowwise().norm();
  return {pose.position - half, pose.position + half};
}

MassProperties Ellipsoid::mass_properties() const {
  const double volume = 4 * std::numbers::pi / 3 * semi_axes_.prod();
  return centered_mass(volume, ellipsoid_moments(volume, semi_axes_));
}

ShapeEntry ellipsoid() {
  return {"ellipsoid",
          "a ball stretched along the body axes",
          {lengths_parameter("semi_axes", "a, b, c")},
          [](const ShapeParameters& p) -> ShapePointer { return std::make_shared<Ellipsoid>(p.vector("semi_axes")); },
          [](double mass, const ShapeParameters& p) { return ellipsoid_moments(mass, p.vector("semi_axes")); },
          "I1 = m (b^2 + c^2)/5, ..."};
}

}  // namespace polhode::collision::shapes
