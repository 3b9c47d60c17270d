// SPDX-License-Identifier: BSD-3-Clause
// Two shapes of any two kinds, at random and degenerate poses, the same ones for a number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::laws {

struct ShapePair {
  std::string kind_a, kind_b;
  std::uint64_t seed = 0;
  ShapePointer a, b;
  Pose at_a, at_b;
  double scale = 0;    ///< size of shapes and distances, m
  double smaller = 0;  ///< size of the smaller shape, m
  bool round = false;  ///< one of them bends in two ways: a search for its depth ends near it
  bool convex = true;  ///< none is a compound
  bool finite = true;  ///< none is a half-space
};

/// Kinds of the catalogue, and a cone for which narrow phases have its support function alone.
const std::vector<std::string>& shape_kinds();

ShapePair shape_pair(const std::string& kind_a, const std::string& kind_b, std::uint64_t seed);

/// The distance of x from the surface of the solid where it reaches furthest along `out`: inside it or beyond the plane
/// there.
double off_surface(const Shape& shape, const Pose& at, const Vector3<double>& x, const Vector3<double>& out);

}  // namespace polhode::laws
