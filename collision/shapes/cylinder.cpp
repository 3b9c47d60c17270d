// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/cylinder.hpp"

#include <cmath>
#include <numbers>

#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

Cylinder::Cylinder(double radius, double length)
    : Shape(ShapeTag::cylinder),
      radius_(positive_size("cylinder", "radius", radius)),
      half_(positive_size("cylinder", "length", length) / 2) {}

Vector3<double> Cylinder::support(const Vector3<double>& d) const {
  const double across = std::hypot(d[0], d[1]), z = std::copysign(half_, d[2]);
  if (across == 0) return {0, 0, z};  // any point of the end: its centre
  return {radius_ * (d[0] / across), radius_ * (d[1] / across), z};
}

// A disc of radius r with the unit normal u reaches r √(1 − u_i²) along axis i.
Bounds Cylinder::bounds(const Pose& pose) const {
  const Matrix3<double>& r = pose.rotation;
  Vector3<double> half;
  for (int i = 0; i < 3; ++i) half[i] = half_ * std::abs(r(i, 2)) + radius_ * std::hypot(r(i, 0), r(i, 1));
  return {pose.position - half, pose.position + half};
}

MassProperties Cylinder::mass_properties() const {
  const double volume = std::numbers::pi * radius_ * radius_ * length();
  return centered_mass(volume, cylinder_moments(volume, radius_, length()));
}

ShapeEntry cylinder() {
  return {"cylinder",
          "a solid cylinder about body axis 3",
          {length_parameter("radius", "r"), length_parameter("length", "l")},
          [](const ShapeParameters& p) -> ShapePointer {
            return std::make_shared<Cylinder>(p.number("radius"), p.number("length"));
          },
          [](double mass, const ShapeParameters& p) {
            return cylinder_moments(mass, p.number("radius"), p.number("length"));
          },
          "I1 = I2 = m (3 r^2 + l^2)/12, I3 = m r^2/2; its axis is body axis 3"};
}

}  // namespace polhode::collision::shapes
