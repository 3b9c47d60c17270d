// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/fat_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polhode::broad {
namespace {

constexpr double steps_ahead = 12;      // how far a margin reaches
constexpr double widest = 0.2;          // margin over mean edge
constexpr double hopeless = 0.1;        // path of a step over mean edge, above which margins are of no use
constexpr double at_first = 0.05;       // over mean edge, before any motion is seen

Box fattened(const Box& b, double margin) {
  Box fat;
  for (std::size_t k = 0; k < 3; ++k) {
    fat.low[k] = b.low[k] - margin;
    fat.high[k] = b.high[k] + margin;
  }
  return fat;
}

}  // namespace

bool FatBoxes::too_large(const Box& b) {
  constexpr double most = 1e75;
  return !(std::min({b.low[0], b.low[1], b.low[2]}) > -most && std::max({b.high[0], b.high[1], b.high[2]}) < most);
}

bool FatBoxes::update(std::span<const Bounds> bounds) {
  take(bounds, next_);
  const bool new_scene = next_.size() != boxes_.size();
  if (new_scene) boxes_ = next_;
  const double margin = margin_of_motion();
  std::swap(boxes_, next_);
  left_.clear();
  before_.clear();
  if (new_scene) {
    fat_.resize(boxes_.size());
    left_.reserve(boxes_.size());
    before_.reserve(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) fat_[i] = fattened(boxes_[i], margin);
    return true;
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (contains(fat_[i], boxes_[i])) continue;
    left_.push_back(static_cast<std::uint32_t>(i));
    before_.push_back(fat_[i]);
    fat_[i] = fattened(boxes_[i], margin);
  }
  return false;
}

/// From the bodies before (boxes_) and now (next_).
double FatBoxes::margin_of_motion() const {
  double path = 0, edge = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < next_.size(); ++i) {
    const Box &a = boxes_[i], &b = next_[i];
    if (too_large(a) || too_large(b)) continue;
    ++counted;
    path += std::max({std::abs(b.low[0] - a.low[0]), std::abs(b.low[1] - a.low[1]), std::abs(b.low[2] - a.low[2])});
    edge += size_of(b);
  }
  if (counted == 0) return 0;
  path /= static_cast<double>(counted);
  edge /= static_cast<double>(counted);
  if (path == 0) return at_first * edge;
  if (path > hopeless * edge) return 0;
  return std::min(steps_ahead * path, widest * edge);
}

}  // namespace polhode::broad
