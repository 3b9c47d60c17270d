// SPDX-License-Identifier: BSD-3-Clause
// A surface as the shaders have it: each corner knows how far it is from the edges of its triangle that are drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/scene/scene.hpp"

namespace polhode::viewer::inline drawing {

struct MeshVertex {
  Vector3<float> point, normal;
  /// m, from the triangle's three edges; of an edge that is not drawn the same large number at all corners.
  /// Interpolated, it is the distance of any point of the triangle (Bærentzen et al., Single-pass wireframe rendering,
  /// 2006).
  Vector3<float> from_edges;
};

struct SurfaceMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> corners;
  float radius = 0;  ///< m, of the ball about the origin that holds it
};

/// Edges are drawn where normals break: where the two triangles at an edge have different normals at its ends, or where
/// there is one triangle alone.
SurfaceMesh mesh_of(const study::Surface& surface);

}  // namespace polhode::viewer
