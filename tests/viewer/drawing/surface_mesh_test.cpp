// SPDX-License-Identifier: BSD-3-Clause
// Edges are drawn where two faces meet, and not across a face.
#include "experiments/viewer/drawing/surface_mesh.hpp"

#include <gtest/gtest.h>

#include "collision/shapes/ellipsoid.hpp"
#include "tests/viewer/stage/stage.hpp"

namespace polhode::viewer::surface_mesh_test {
namespace {

TEST(SurfaceMesh, ACubeHasTwelveEdgesAndNoDiagonals) {
  const SurfaceMesh mesh = mesh_of(cube_surface(0.4));
  EXPECT_NEAR(mesh.radius, 0.2 * std::sqrt(3.0), 1e-6);
  std::size_t edges = 0, diagonals = 0;
  for (std::size_t t = 0; t + 2 < mesh.corners.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto component = Eigen::Index(k);
      const float here = mesh.vertices[mesh.corners[t + k]].from_edges[component];
      const float there = mesh.vertices[mesh.corners[t + (k + 1) % 3]].from_edges[component];
      if (here == there) {
        ++diagonals;
        EXPECT_GT(here, 100 * mesh.radius);
      } else {
        ++edges;
        EXPECT_NEAR(here, 0.4, 1e-6);  // the height of the triangle above its edge
        EXPECT_EQ(there, 0);
      }
    }
  }
  EXPECT_EQ(edges, 24u);  // each on both of its sides
  EXPECT_EQ(diagonals, 12u);
}

TEST(SurfaceMesh, ASmoothSurfaceHasNoEdgesAndKeepsItsCorners) {
  const study::Surface surface = study::surface_of(Ellipsoid(Vector3<double>(1, 2, 3)));
  const SurfaceMesh mesh = mesh_of(surface);
  for (const MeshVertex& v : mesh.vertices) EXPECT_GT(v.from_edges.minCoeff(), 100 * mesh.radius);
  EXPECT_LE(mesh.vertices.size(), surface.points.size());
}

}  // namespace
}  // namespace polhode::viewer::surface_mesh_test
