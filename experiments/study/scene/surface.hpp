// SPDX-License-Identifier: BSD-3-Clause
// The surface of a shape as triangles, for drawing.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::study::inline scene {

/// Triangles in the shape's own axes (m). A corner is stored once for each of its normals.
struct Surface {
  std::vector<Vector3<float>> points, normals;  ///< the same number of both; normals are outward unit vectors
  std::vector<std::uint32_t> corners;  ///< three indices for each triangle, counter-clockwise seen from outside
};

/// The surface of a finite shape: the hull of its support points along directions spread over the sphere. Exact for
/// polyhedra. Normals are flat at edges sharper than 30 degrees and smooth elsewhere.
Surface surface_of(const Shape& shape);

}  // namespace polhode::study::scene
