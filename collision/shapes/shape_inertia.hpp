// SPDX-License-Identifier: BSD-3-Clause
// The inertia of simple shapes about their mass centre, kg m², in their own axes, from mass (kg) and sizes (m).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.hpp"
#include "core/problem/force_kind.hpp"

namespace polhode {

// Principal moments about the mass centre; the axis of a cylinder or capsule is body axis 3, and the length of a
// capsule that of its cylindrical part.
Vector3<double> sphere_moments(double mass, double radius);
Vector3<double> box_moments(double mass, const Vector3<double>& size);  ///< size: full edge lengths
Vector3<double> cylinder_moments(double mass, double radius, double length);
Vector3<double> capsule_moments(double mass, double radius, double length);
Vector3<double> ellipsoid_moments(double mass, const Vector3<double>& semi_axes);

/// A shape as a scenario names it: shape = { kind = "box", size = [0.1, 0.4, 0.9] }.
struct ShapeKind {
  std::string name;
  std::string summary;                ///< its inertia as a formula
  std::vector<Parameter> parameters;  ///< sizes: numbers or vectors
  /// Principal moments about the mass centre; the map has every key of `parameters`.
  Vector3<double> (*moments)(double mass, const std::map<std::string, ParameterValue>& sizes);
};

/// One line registers a shape's inertia.
const std::vector<ShapeKind>& shape_catalogue();
const ShapeKind* find_shape(std::string_view name);

}  // namespace polhode
