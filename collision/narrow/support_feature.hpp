// SPDX-License-Identifier: BSD-3-Clause
// What a convex shape turns towards another one: a face, an edge, or a point. Round shapes are cut into what matters:
// the side of a capsule or a cylinder is an edge, the end of a cylinder a face with corners on its rim.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::inline collision {

/// Numbers are those of the polytope of a box or a hull. A capsule's ends are vertices 0 (below) and 1, its side edge
/// 0. A cylinder's ends are faces 0 (below) and 1 and edges as their corners, from 32 times the face on; its side is
/// edge 64 with the ends 64 and 65; any other point of a rim is vertex 96 or 97. All else has vertex 0 only.
struct SupportFeature {
  enum class Kind : std::uint8_t { point, edge, face };
  struct Corner {
    Vector3<double> at;                  ///< m, in the shape's axes
    std::uint32_t vertex = 0, edge = 0;  ///< the edge is the one that leaves the corner
  };
  Kind kind = Kind::point;
  std::uint32_t face = 0;
  Vector3<double> normal;       ///< of the face: unit, outward, in the shape's axes
  std::vector<Corner> corners;  ///< of a face counter-clockwise, seen from outside
};

/// Of a convex, finite shape along the unit direction d in its axes: the face that looks along it or at most 0.1 rad
/// beside it, else an edge as much across it, else the furthest point. Takes no memory once `feature` has had as many
/// corners.
void support_feature(const Shape& shape, const Vector3<double>& d, SupportFeature& feature);

}  // namespace polhode
