// SPDX-License-Identifier: BSD-3-Clause
// The feature of a convex shape in a direction: a face, an edge, or a point. Round shapes have these features: the side
// of a capsule or a cylinder is an edge, the end of a cylinder a face with corners on its rim.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::inline collision::inline narrow {

/// Features of boxes and hulls are numbered as in their polytope. The ends of a capsule are vertices 0 (below) and 1,
/// its side is edge 0. The ends of a cylinder are faces 0 (below) and 1; their corners and edges are numbered from 32
/// times the face on. Its side is edge 64 with the ends 64 and 65; any other point of a rim is vertex 96 or 97. All
/// other shapes have vertex 0 only.
struct SupportFeature {
  enum class Kind : std::uint8_t { point, edge, face };
  struct Corner {
    Vector3<double> at;                  ///< position in the shape's axes, m
    std::uint32_t vertex = 0, edge = 0;  ///< the edge is the one that leaves the corner
  };
  Kind kind = Kind::point;
  std::uint32_t face = 0;
  Vector3<double> normal;       ///< outward unit normal of a face, in the shape's axes
  std::vector<Corner> corners;  ///< corners, those of a face counter-clockwise seen from outside
};

/// Finds the feature of a finite convex shape along the unit direction d, in its axes: the face whose normal is at most
/// 0.1 rad from d; else an edge at most 0.1 rad from perpendicular to d; else the furthest point. Allocates no memory
/// once `feature` has had as many corners.
void support_feature(const Shape& shape, const Vector3<double>& d, SupportFeature& feature);

}  // namespace polhode::collision::narrow
