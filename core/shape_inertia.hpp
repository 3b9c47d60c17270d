// SPDX-License-Identifier: BSD-3-Clause
// The inertia of simple shapes about their mass centre, kg m², in their own axes, from mass (kg) and sizes (m).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/force_kind.hpp"
#include "core/linear_algebra.hpp"

namespace polhode {

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
