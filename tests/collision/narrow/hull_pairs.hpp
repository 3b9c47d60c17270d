// SPDX-License-Identifier: BSD-3-Clause
// Random and degenerate pairs of convex hulls of 4 to 128 points, the same ones for a number.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "collision/shapes/convex_hull.hpp"

namespace polhode {

struct HullPairCase {
  std::string what;
  std::vector<Vector3<double>> points_a, points_b;
  std::shared_ptr<const ConvexHull> a, b;
  Pose at_a, at_b;
};

const std::vector<std::string>& hull_pair_classes();

/// Pair number k of a sequence; its class is k modulo the number of classes.
HullPairCase hull_pair_case(std::uint64_t seed, std::uint64_t k);

}  // namespace polhode
