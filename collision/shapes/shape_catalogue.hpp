// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of shapes: a name, its sizes, and how it is built from them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "collision/shape.hpp"
#include "core/problem/force_kind.hpp"

namespace polhode {

/// The values of a shape's sizes, every key of its entry present.
struct ShapeParameters {
  std::map<std::string, ParameterValue> values;

  double number(const std::string& key) const { return std::get<double>(values.at(key)); }
  const Vector3<double>& vector(const std::string& key) const { return std::get<Vector3<double>>(values.at(key)); }
  const std::string& text(const std::string& key) const { return std::get<std::string>(values.at(key)); }
};

struct ShapeEntry {
  std::string name;
  std::string summary;                ///< one line: which points it holds
  std::vector<Parameter> parameters;  ///< as a scenario gives them
  /// Throws std::invalid_argument with the reason.
  ShapePointer (*make)(const ShapeParameters&);
};

const std::vector<ShapeEntry>& collision_shape_catalogue();
const ShapeEntry* find_collision_shape(std::string_view name);

/// The sizes of a shape whose moments are in collision/shapes/shape_inertia.hpp, so that its keys are written down
/// once.
std::vector<Parameter> sizes_of_core_shape(std::string_view name);

}  // namespace polhode
