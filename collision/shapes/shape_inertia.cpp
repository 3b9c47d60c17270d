// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of shapes. Each formula is the integral of the slides' sums over a body of even density.
#include "collision/shapes/shape_inertia.hpp"

#include <algorithm>

namespace polhode {

namespace {

using Sizes = std::map<std::string, ParameterValue>;

double number(const Sizes& sizes, const char* key) { return std::get<double>(sizes.at(key)); }
const Vector3<double>& vector(const Sizes& sizes, const char* key) { return std::get<Vector3<double>>(sizes.at(key)); }

/// The moments (b² + c², a² + c², a² + b²) of half the inertia of a body whose second moments are a², b², c².
Vector3<double> perpendicular(const Vector3<double>& v) {
  const Vector3<double> s = v.cwiseAbs2();
  return {s[1] + s[2], s[0] + s[2], s[0] + s[1]};
}

Vector3<double> sphere(double mass, const Sizes& s) { return sphere_moments(mass, number(s, "radius")); }
Vector3<double> box(double mass, const Sizes& s) { return box_moments(mass, vector(s, "size")); }
Vector3<double> ellipsoid(double mass, const Sizes& s) { return ellipsoid_moments(mass, vector(s, "semi_axes")); }
Vector3<double> cylinder(double mass, const Sizes& s) {
  return cylinder_moments(mass, number(s, "radius"), number(s, "length"));
}
Vector3<double> capsule(double mass, const Sizes& s) {
  return capsule_moments(mass, number(s, "radius"), number(s, "length"));
}

Parameter length(const char* key, const char* meaning, Parameter::Range range = Parameter::Range::positive) {
  return {key, 0.0, "m", meaning, Parameter::Need::required, range};
}

Parameter three_lengths(const char* key, const char* meaning) {
  return {key, Vector3<double>(0, 0, 0), "m", meaning, Parameter::Need::required, Parameter::Range::positive};
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

const std::vector<ShapeKind>& shape_catalogue() {
  using enum Parameter::Range;
  static const std::vector<ShapeKind> shapes = {
      {"box", "I1 = m (b^2 + c^2)/12, ...", {three_lengths("size", "full edge lengths a, b, c")}, box},
      {"sphere", "I = 2 m r^2/5", {length("radius", "r")}, sphere},
      {"cylinder",
       "I1 = I2 = m (3 r^2 + l^2)/12, I3 = m r^2/2; its axis is body axis 3",
       {length("radius", "r"), length("length", "l")},
       cylinder},
      {"capsule",
       "a cylinder between two half balls, as their sum; its axis is body axis 3",
       {length("radius", "r"), length("length", "l, of the cylindrical part", non_negative)},
       capsule},
      {"ellipsoid", "I1 = m (b^2 + c^2)/5, ...", {three_lengths("semi_axes", "a, b, c")}, ellipsoid},
  };
  return shapes;
}

const ShapeKind* find_shape(std::string_view name) {
  const auto& all = shape_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ShapeKind& s) { return s.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace polhode
