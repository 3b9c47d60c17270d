// SPDX-License-Identifier: BSD-3-Clause
// The facets of the convex hull of points, as qhull finds them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision {

/// Loops of point numbers, counter-clockwise seen from outside. Coplanar facets are one loop, or with `triangulated`
/// several triangles. Throws std::invalid_argument where qhull gives up.
std::vector<std::vector<std::uint32_t>> qhull_faces(std::span<const Vector3<double>> points, bool triangulated);

}  // namespace polhode
