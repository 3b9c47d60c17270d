// SPDX-License-Identifier: BSD-3-Clause
// Pairs as a broad phase finds them, in any order but none twice, and sorted in the end: counted by their first body, which
// takes linear time, and the few of each body as they come. Where pairs are few, bodies are counted together, so that the
// time goes with the pairs, not with the bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad_phase.hpp"

namespace polhode::broad {

class PairList {
 public:
  void clear() { found_.clear(); }
  void add(std::uint32_t a, std::uint32_t b) { found_.push_back(a < b ? BodyPair{a, b} : BodyPair{b, a}); }

  /// Of `bodies` bodies; valid until the next call.
  std::span<const BodyPair> sorted(std::size_t bodies);

 private:
  std::vector<BodyPair> found_, sorted_;
  std::vector<std::uint32_t> place_;  // of each first body, or of a few, where the next pair goes
};

}  // namespace polhode::broad
