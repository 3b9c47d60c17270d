// SPDX-License-Identifier: BSD-3-Clause
// The loose quadtree over x and y: for scenes that spread over the ground. See loose_tree.hpp; Finkel and Bentley,
// "Quad Trees" (1974), made loose after Ulrich (2000).
#include "collision/broad/loose_tree.hpp"

namespace polhode::inline collision::inline broad {

BroadPhaseEntry quadtree() {
  return {
      "quadtree",
      "a loose tree of squares over x and y, large boxes in its inner nodes; heights are told apart by the boxes alone",
      [] { return std::unique_ptr<BroadPhase>(new broad::LooseTree<2>); }};
}

}  // namespace polhode::collision::broad
