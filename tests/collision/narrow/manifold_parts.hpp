// SPDX-License-Identifier: BSD-3-Clause
// Parts of a manifold that tests compare.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>

#include "collision/contact.hpp"

namespace polhode {

using FeatureName = std::tuple<Feature::Kind, std::uint32_t, std::uint32_t>;

/// The features of all contact points.
inline std::set<FeatureName> names(const Manifold& m) {
  std::set<FeatureName> all;
  for (std::size_t k = 0; k < m.count; ++k)
    all.insert({m.points[k].feature.kind, m.points[k].feature.of_a, m.points[k].feature.of_b});
  return all;
}

/// The largest depth of a contact point, m.
inline double deepest(const Manifold& m) {
  double depth = -1e300;
  for (std::size_t k = 0; k < m.count; ++k) depth = std::max(depth, m.points[k].depth);
  return depth;
}

}  // namespace polhode
