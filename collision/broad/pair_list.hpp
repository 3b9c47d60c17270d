// SPDX-License-Identifier: BSD-3-Clause
// Pairs as a broad phase finds them, in any order but none twice, and sorted in the end: counted by their first body,
// which takes linear time, and the few of each body as they come. Where pairs are few, bodies are counted together, so
// that the time goes with the pairs, not with the bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad_phase.hpp"

namespace polhode::inline collision::broad {

/// Their number grows with the square of the bodies in one place: more than so many would end in want of memory.
inline constexpr std::size_t most_pairs = 50'000'000;
/// Throws std::length_error, which names the cause and the remedy.
[[noreturn]] void too_many_pairs();

class PairList {
 public:
  void clear() { found_.clear(); }
  void add(std::uint32_t a, std::uint32_t b) {
    if (found_.size() == most_pairs) too_many_pairs();
    found_.push_back(a < b ? BodyPair{a, b} : BodyPair{b, a});
  }

  /// Of `bodies` bodies; valid until the next call.
  std::span<const BodyPair> sorted(std::size_t bodies);

 private:
  std::vector<BodyPair> found_, sorted_;
  std::vector<std::uint32_t> place_;  // of each first body, or of a few, where the next pair goes
};

}  // namespace polhode::broad
