// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/shape_catalogue.hpp"

#include "core/problem/catalogue.hpp"

// One line lists a shape: the function of its name, in the file of its name, declares it.
#define POLHODE_SHAPES(SHAPE) \
  SHAPE(sphere) \
  SHAPE(box) \
  SHAPE(capsule) \
  SHAPE(cylinder) \
  SHAPE(ellipsoid) \
  SHAPE(convex_hull) \
  SHAPE(compound) \
  SHAPE(half_space)

namespace polhode::inline collision::inline shapes {

POLHODE_CATALOGUE(ShapeEntry, shape_catalogue, POLHODE_SHAPES)

const ShapeEntry* find_shape(std::string_view name) { return find_entry(shape_catalogue(), name); }

Parameter length_parameter(const char* key, const char* meaning, Parameter::Range range) {
  return {key, 0.0, "m", meaning, Parameter::Need::required, range};
}

Parameter lengths_parameter(const char* key, const char* meaning) {
  return {key, Vector3<double>(0, 0, 0), "m", meaning, Parameter::Need::required, Parameter::Range::positive};
}

}  // namespace polhode::collision::shapes
