// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of shapes: name, sizes, and how to build a shape from its sizes.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "collision/shape.hpp"
#include "core/problem/force_kind.hpp"

namespace polhode::inline collision::inline shapes {

/// The sizes of a shape; every key of its entry is present.
struct ShapeParameters {
  std::map<std::string, ParameterValue> values;

  double number(const std::string& key) const { return std::get<double>(values.at(key)); }
  const Vector3<double>& vector(const std::string& key) const { return std::get<Vector3<double>>(values.at(key)); }
  const std::string& text(const std::string& key) const { return std::get<std::string>(values.at(key)); }
};

/// A shape as a scenario names it: shape = { kind = "box", size = [0.1, 0.4, 0.9] }.
struct ShapeEntry {
  std::string name;
  std::string summary;                ///< one line: the points that the shape consists of
  std::vector<Parameter> parameters;  ///< sizes as a scenario gives them
  /// Builds the shape. Throws std::invalid_argument with the reason.
  ShapePointer (*make)(const ShapeParameters&);

  /// Principal moments (kg m²) about the mass centre from the mass (kg), also for sizes that `make` refuses. Null: the
  /// inertia is that of the shape that `make` builds.
  Vector3<double> (*moments)(double mass, const ShapeParameters&) = nullptr;
  std::string moments_formula{};  ///< one line
};

const std::vector<ShapeEntry>& shape_catalogue();
const ShapeEntry* find_shape(std::string_view name);

/// A length (m) that a scenario must give.
Parameter length_parameter(const char* key, const char* meaning, Parameter::Range range = Parameter::Range::positive);
/// Three positive lengths (m) that a scenario must give.
Parameter lengths_parameter(const char* key, const char* meaning);

}  // namespace polhode::collision::shapes
