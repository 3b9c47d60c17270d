// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/shape_catalogue.hpp"

#include <algorithm>
#include <stdexcept>

#include "collision/shapes/shape_inertia.hpp"

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

namespace polhode {

#define POLHODE_DECLARE(name) ShapeEntry name();
POLHODE_SHAPES(POLHODE_DECLARE)

const std::vector<ShapeEntry>& collision_shape_catalogue() {
#define POLHODE_ENTRY(name) name(),
  static const std::vector<ShapeEntry> entries = {POLHODE_SHAPES(POLHODE_ENTRY)};
  return entries;
}

const ShapeEntry* find_collision_shape(std::string_view name) {
  const auto& all = collision_shape_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ShapeEntry& s) { return s.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<Parameter> sizes_of_core_shape(std::string_view name) {
  const ShapeKind* kind = find_shape(name);
  if (!kind) throw std::logic_error("collision/shapes/shape_inertia.cpp has no " + std::string(name));
  return kind->parameters;
}

}  // namespace polhode
