// SPDX-License-Identifier: BSD-3-Clause
// The judge of two convex hulls: their signed distance in whole numbers, so that every sign is right. Only the last
// division and root are rounded, in long double.
#pragma once

#include <vector>

#include "collision/pose.hpp"
#include "tests/collision/narrow/exact_boxes.hpp"

namespace polhode {

/// The convex hull of points, at position + rotation · point, each number taken as it stands: the rotation need not be
/// quite orthogonal.
struct ExactHull {
  std::vector<Vector3<double>> points;
  Pose pose;
};

/// Needs two hulls with a volume.
ExactDistance exact_distance(const ExactHull& a, const ExactHull& b);

}  // namespace polhode
