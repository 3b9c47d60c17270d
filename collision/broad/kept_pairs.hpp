// SPDX-License-Identifier: BSD-3-Clause
// Pairs whose fat boxes overlap, kept from step to step, as the neighbour lists of molecular dynamics are (Verlet,
// "Computer 'experiments' on classical fluids", 1967). A structure over the fat boxes is asked only about bodies that
// left theirs; all other pairs are those of the step before, and their true boxes are tested as they come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/pair_list.hpp"

namespace polhode::inline collision::broad {

class KeptPairs {
 public:
  /// Nothing is known any more; add() gets all pairs of fat boxes.
  void forget() { kept_count_ = 0; }

  /// A pair of fat boxes, at least one of which is new in this step; each pair once.
  void add(std::uint32_t a, std::uint32_t b) { fresh_.add(a, b); }

  /// After all calls of add() of a step: the pairs whose true boxes overlap, sorted; valid until the next call.
  std::span<const BodyPair> renew(const FatBoxes& boxes, std::span<const Bounds> bounds);

 private:
  PairList fresh_;
  std::vector<BodyPair> kept_, next_, pairs_;  // sorted; room, of which so many are in use:
  std::size_t kept_count_ = 0;
};

}  // namespace polhode::broad
