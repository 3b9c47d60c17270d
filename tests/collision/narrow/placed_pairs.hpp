// SPDX-License-Identifier: BSD-3-Clause
// Random and degenerate pairs of shapes, the same ones for a number, and plain enumerations to compare with.
#pragma once

#include <cstdint>

#include "collision/shape.hpp"

namespace polhode {

struct PlacedPair {
  ShapePointer a, b;
  Pose at_a, at_b;
  double size_a = 0, size_b = 0;  ///< largest half extent, or its order of magnitude, m
  bool polytopes = true;          ///< spheres and capsules count, since their cores have corners only
};

Pose random_pose(std::uint64_t seed, double spread);

/// Hulls of 4 to 128 points.
PlacedPair hull_pair(std::uint64_t k);

/// A pair of any convex kinds but the half-space.
PlacedPair any_pair(std::uint64_t seed);

/// Two hulls: the largest separation along all normals of faces and products of edges, in long double.
long double separation_of_hulls(const PlacedPair& pair);

}  // namespace polhode
