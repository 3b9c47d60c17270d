// SPDX-License-Identifier: BSD-3-Clause
// The surface of a shape as triangles, to be drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::study::inline scene {

/// A surface as triangles, m, in the shape's own axes; corners stand once for each normal that they have.
struct Surface {
  std::vector<Vector3<float>> points, normals;  ///< the same number; normals outward, of unit length
  std::vector<std::uint32_t> corners;           ///< three of them a triangle, counterclockwise from outside
};

/// Of any finite shape: what its support function reaches along directions that are spread over the sphere, and their
/// hull. Of what has only corners it is exact. Normals are flat at edges sharper than 30 degrees and smooth elsewhere.
Surface surface_of(const Shape& shape);

}  // namespace polhode::study
