// SPDX-License-Identifier: BSD-3-Clause
// Pairs whose fat boxes overlap, kept from step to step like the neighbour lists of molecular dynamics (Verlet,
// "Computer 'experiments' on classical fluids", 1967). Only bodies that left their fat boxes are queried again; all
// other pairs are those of the previous step. The true boxes of all pairs are tested in each step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/pair_list.hpp"

namespace polhode::inline collision::inline broad {

class KeptPairs {
 public:
  /// Clears everything; add() must then be given all pairs of fat boxes.
  void forget() { kept_count_ = 0; }

  /// Adds a pair of fat boxes of which at least one is new in this step; each pair once.
  void add(std::uint32_t a, std::uint32_t b) { fresh_.add(a, b); }

  /// The pairs whose true boxes overlap, sorted, valid until the next call. All calls of add() in a step come before
  /// it.
  std::span<const BodyPair> renew(const FatBoxes& boxes, std::span<const Bounds> bounds);

 private:
  PairList fresh_;
  std::vector<BodyPair> kept_, next_, pairs_;  // sorted; room, of which so many are in use:
  std::size_t kept_count_ = 0;
};

}  // namespace polhode::collision::broad
