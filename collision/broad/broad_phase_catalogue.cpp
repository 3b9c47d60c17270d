// SPDX-License-Identifier: BSD-3-Clause

#include "collision/broad_phase.hpp"
#include "core/problem/catalogue.hpp"

// One line lists a broad phase: the function of its name, in the file of its name in broad/, makes its entry.
#define POLHODE_BROAD_PHASES(PHASE) \
  PHASE(all_pairs) \
  PHASE(sweep_and_prune) \
  PHASE(uniform_grid) \
  PHASE(quadtree) \
  PHASE(octree) \
  PHASE(bsp_tree) \
  PHASE(bvh)

namespace polhode::inline collision {

#define POLHODE_DECLARE(name) BroadPhaseEntry name();
POLHODE_BROAD_PHASES(POLHODE_DECLARE)

const std::vector<BroadPhaseEntry>& broad_phase_catalogue() {
#define POLHODE_ENTRY(name) name(),
  static const std::vector<BroadPhaseEntry> entries = {POLHODE_BROAD_PHASES(POLHODE_ENTRY)};
  return entries;
}

const BroadPhaseEntry* find_broad_phase(std::string_view name) { return find_entry(broad_phase_catalogue(), name); }

}  // namespace polhode::collision
