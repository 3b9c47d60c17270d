// SPDX-License-Identifier: BSD-3-Clause
// A surface in the layout of the shaders: each corner stores its distance from the drawn edges of its triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/study/scene/scene.hpp"

namespace polhode::viewer::inline drawing {

struct MeshVertex {
  Vector3<float> point, normal;
  /// Distances (m) from the triangle's three edges; for an edge that is not drawn, the same large number at all
  /// corners. Interpolated, it is the distance of any point of the triangle (Bærentzen et al., Single-pass wireframe
  /// rendering, 2006).
  Vector3<float> from_edges;
};

struct SurfaceMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> corners;
  float radius = 0;  ///< radius of the ball about the origin that contains the surface, m
};

/// Builds the mesh. Edges are drawn where the two adjacent triangles have different normals at its ends, and at the
/// boundary of the surface.
SurfaceMesh mesh_of(const study::Surface& surface);

}  // namespace polhode::viewer::drawing
