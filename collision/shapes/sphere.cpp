// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/sphere.hpp"

#include <numbers>

#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

Sphere::Sphere(double radius) : Shape(ShapeTag::sphere), radius_(positive_size("sphere", "radius", radius)) {}

Bounds Sphere::bounds(const Pose& pose) const {
  const Vector3<double> half = Vector3<double>::Constant(radius_);
  return {pose.position - half, pose.position + half};
}

MassProperties Sphere::mass_properties() const {
  const double volume = 4 * std::numbers::pi / 3 * radius_ * radius_ * radius_;
  return centered_mass(volume, sphere_moments(volume, radius_));
}

ShapeEntry sphere() {
  return {"sphere",
          "all points no further than the radius from the centre",
          {length_parameter("radius", "r")},
          [](const ShapeParameters& p) -> ShapePointer { return std::make_shared<Sphere>(p.number("radius")); },
          [](double mass, const ShapeParameters& p) { return sphere_moments(mass, p.number("radius")); },
          "I = 2 m r^2/5"};
}

}  // namespace polhode::collision::shapes
