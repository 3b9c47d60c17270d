// SPDX-License-Identifier: BSD-3-Clause
// Collects pairs in any order, each once, and sorts them: a counting sort by the first body, in linear time, then the
// few pairs of each body by comparison. If there are few pairs, several bodies share a counter, so that the time is
// proportional to the pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {

/// Limit of the number of pairs, which grows with the square of the bodies in one place and would exhaust memory.
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

  /// The sorted pairs of `bodies` bodies; valid until the next call.
  std::span<const BodyPair> sorted(std::size_t bodies);

 private:
  std::vector<BodyPair> found_, sorted_;
  std::vector<std::uint32_t> place_;  // place of the next pair for each first body, or for each few
};

}  // namespace polhode::collision::broad
