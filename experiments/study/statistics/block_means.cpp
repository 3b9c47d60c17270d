// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/block_means.hpp"

#include <algorithm>

namespace polhode::study::inline statistics {

void BlockMeans::add(Strided t, Strided values, std::size_t count) {
  for (std::size_t i = 0; i < count;) {
    const std::size_t end = std::min(count, i + per_block_ - in_open_);
    BlockMean sum = open_;  // local copy, so that the compiler keeps it in registers
    const std::size_t more = end - i;
    for (; i < end; ++i) {
      sum.t += t[i];
      sum.value += values[i];
    }
    set_open_sums(sum, more);
  }
}

void BlockMeans::set_open_sums(const BlockMean& sums, std::size_t count) {
  in_open_ += count;
  if (in_open_ == per_block_) close(sums);
  else open_ = sums;
}

void BlockMeans::close(const BlockMean& open) {
  sums_[closed_++] = open;
  open_ = {};
  in_open_ = 0;
  if (closed_ < capacity) return;
  for (std::size_t i = 0; i < capacity / 2; ++i) {
    const BlockMean &a = sums_[2 * i], &b = sums_[2 * i + 1];
    sums_[i] = {a.t + b.t, a.value + b.value};
  }
  closed_ = capacity / 2;
  per_block_ *= 2;
}

std::vector<BlockMean> BlockMeans::finish() const {
  std::vector<BlockMean> means;
  means.reserve(closed_ + 1);
  const auto mean = [&](const BlockMean& sum, std::size_t n) {
    means.push_back({sum.t / static_cast<double>(n), sum.value / static_cast<double>(n)});
  };
  for (std::size_t i = 0; i < closed_; ++i) mean(sums_[i], per_block_);
  if (2 * in_open_ >= per_block_ && in_open_ > 0) mean(open_, in_open_);
  return means;
}

}  // namespace polhode::study::statistics
