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

namespace polhode::inline collision::inline broad {

POLHODE_CATALOGUE(BroadPhaseEntry, broad_phase_catalogue, POLHODE_BROAD_PHASES)

const BroadPhaseEntry* find_broad_phase(std::string_view name) { return find_entry(broad_phase_catalogue(), name); }

}  // namespace polhode::collision::broad
