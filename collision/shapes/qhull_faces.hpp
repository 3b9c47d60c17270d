// SPDX-License-Identifier: BSD-3-Clause
// The facets of the convex hull of points, computed by qhull.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision::inline shapes {

/// Facets as loops of point numbers, counter-clockwise seen from outside. Coplanar facets are merged into one loop, or
/// with `triangulated` split into triangles. Throws std::invalid_argument if qhull fails.
std::vector<std::vector<std::uint32_t>> qhull_faces(std::span<const Vector3<double>> points, bool triangulated);

}  // namespace polhode::collision::shapes
