// SPDX-License-Identifier: BSD-3-Clause
// The loose octree. See loose_tree.hpp; Meagher, "Octree Encoding" (1980), made loose after Ulrich (2000).
#include "collision/broad/loose_tree.hpp"

namespace polhode::inline collision::inline broad {

BroadPhaseEntry octree() {
  return {"octree", "a loose tree of cubes, large boxes in its inner nodes",
          [] { return std::unique_ptr<BroadPhase>(new broad::LooseTree<3>); }};
}

}  // namespace polhode::collision::broad
