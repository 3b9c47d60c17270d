// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/capsule.hpp"

#include <numbers>

#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

Capsule::Capsule(double radius, double length)
    : Shape(ShapeTag::capsule),
      radius_(positive_size("capsule", "radius", radius)),
      half_(non_negative_size("capsule", "length", length) / 2) {}

Bounds Capsule::bounds(const Pose& pose) const {
  const Vector3<double> half = half_ * pose.rotation.col(2).cwiseAbs() + Vector3<double>::Constant(radius_);
  return {pose.position - half, pose.position + half};
}

MassProperties Capsule::mass_properties() const {
  const double volume = std::numbers::pi * radius_ * radius_ * (length() + 4 * radius_ / 3);
  return centered_mass(volume, capsule_moments(volume, radius_, length()));
}

ShapeEntry capsule() {
  return {"capsule",
          "all points no further than the radius from a segment on body axis 3",
          {length_parameter("radius", "r"),
           length_parameter("length", "l, of the cylindrical part", Parameter::Range::non_negative)},
          [](const ShapeParameters& p) -> ShapePointer {
            return std::make_shared<Capsule>(p.number("radius"), p.number("length"));
          },
          [](double mass, const ShapeParameters& p) {
            return capsule_moments(mass, p.number("radius"), p.number("length"));
          },
          "a cylinder between two half balls, as their sum; its axis is body axis 3"};
}

}  // namespace polhode::collision::shapes
