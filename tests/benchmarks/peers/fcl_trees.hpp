// SPDX-License-Identifier: BSD-3-Clause
// FCL's dynamic trees of boxes, behind plain numbers: FCL is built with another alignment of Eigen's types than
// polhode, so that no such type may pass from one to the other.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace polhode::peers {

class FclTree {
 public:
  virtual ~FclTree() = default;
  /// Box i has its centre at centres[3 i]. Returns the number of pairs of overlapping bounds.
  virtual std::size_t step(const std::vector<double>& centres) = 0;
};

/// DynamicAABBTreeCollisionManager, or its variant with nodes in an array. Box i has the half extents halves[3 i] on.
std::unique_ptr<FclTree> fcl_tree(const std::vector<double>& halves, bool in_array);

}  // namespace polhode::peers
