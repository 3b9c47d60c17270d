// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "collision/broad_phase.hpp"

// One line lists a broad phase: the function of its name, in the file of its name in broad/, makes its entry.
#define POLHODE_BROAD_PHASES(PHASE) \
  PHASE(all_pairs) \
  PHASE(sweep_and_prune) \
  PHASE(uniform_grid) \
  PHASE(quadtree) \
  PHASE(octree) \
  PHASE(bsp_tree) \
  PHASE(bvh)

namespace polhode {

#define POLHODE_DECLARE(name) BroadPhaseEntry name();
POLHODE_BROAD_PHASES(POLHODE_DECLARE)

const std::vector<BroadPhaseEntry>& broad_phase_catalogue() {
#define POLHODE_ENTRY(name) name(),
  static const std::vector<BroadPhaseEntry> entries = {POLHODE_BROAD_PHASES(POLHODE_ENTRY)};
  return entries;
}

const BroadPhaseEntry* find_broad_phase(std::string_view name) {
  const auto& all = broad_phase_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace polhode
