// SPDX-License-Identifier: BSD-3-Clause
// Reduction of a series of any length to at most 128 means.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "experiments/study/statistics/strided.hpp"

namespace polhode::study::inline statistics {

struct BlockMean {
  double t = 0;      ///< s
  double value = 0;  ///< mean of the drift, in any unit
};

/// Means of a series over blocks of equally many samples; when all blocks are in use, neighbours are merged.
class BlockMeans {
 public:
  void add(double t, double value) { add({&t}, {&value}, 1); }
  /// Adds `count` consecutive samples.
  void add(Strided t, Strided values, std::size_t count);

  /// Number of samples that complete the open block, and the sums of t and value in it.
  std::size_t room() const { return per_block_ - in_open_; }
  const BlockMean& open_sums() const { return open_; }
  /// Replaces the sums of the open block by those with `count` more samples, at most room().
  void set_open_sums(const BlockMean& sums, std::size_t count);

  /// The blocks. The last one is included if it is at least half full.
  std::vector<BlockMean> finish() const;

 private:
  static constexpr std::size_t capacity = 128;
  void close(const BlockMean& open);

  std::array<BlockMean, capacity> sums_;  ///< sums of t and value in the closed blocks
  std::size_t closed_ = 0;
  BlockMean open_;
  std::size_t in_open_ = 0, per_block_ = 1;
};

}  // namespace polhode::study::statistics
