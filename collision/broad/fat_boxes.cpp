// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/fat_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace polhode::broad {
namespace {

constexpr std::uint32_t fewest_ahead = 12, most_ahead = 20;  // steps that the room is for
constexpr double widest = 0.25;     // reach ahead over the longest edge
constexpr double hopeless = 0.1;    // path of a step over the longest edge, above which room is of no use
constexpr double thin = 0.01;       // margin on all sides over the edge across it

/// A number that looks like chance, but is the same in every run.
std::uint32_t scatter(std::uint32_t body, std::uint32_t step) {
  std::uint32_t h = body * 0x9E3779B1u ^ step * 0x85EBCA77u;
  h = (h ^ h >> 15) * 0xC2B2AE3Du;
  return h ^ h >> 16;
}

}  // namespace

bool FatBoxes::too_large(const Box& b) {
  constexpr double most = 1e75;
  return !(std::min({b.low[0], b.low[1], b.low[2]}) > -most && std::max({b.high[0], b.high[1], b.high[2]}) < most);
}

bool FatBoxes::update(std::span<const Bounds> bounds) {
  const std::size_t n = bounds.size();
  if (n != boxes_.size()) {
    take(bounds, boxes_);
    begin_scene();
    return true;
  }
  check(bounds);
  ++steps_;
  for (const std::uint32_t body : left_) has_left_[body] = 0;
  left_.resize(n);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Box now = box_of(bounds[i]);
    left_[count] = static_cast<std::uint32_t>(i);
    if (!contains(fat_[i], now)) last_[count++] = boxes_[i];
    boxes_[i] = now;
  }
  left_.resize(count);
  // Many that leave together, as when a scene begins to move, shall not do so again.
  const std::uint32_t fewest = count > n / 2 ? 1 : fewest_ahead;
  for (std::size_t k = 0; k < count; ++k) {
    before_[k] = fat_[left_[k]];
    has_left_[left_[k]] = 1;
    renew(left_[k], last_[k], fewest);
  }
  return false;
}

void FatBoxes::begin_scene() {
  const std::size_t n = boxes_.size();
  fat_.resize(n);
  last_.resize(n);
  before_.resize(n);
  left_.resize(n);
  std::iota(left_.begin(), left_.end(), std::uint32_t(0));
  has_left_.assign(n, 1);
  steps_ = 0;
  for (const std::uint32_t body : left_) renew(body, boxes_[body], 1);
}

void FatBoxes::renew(std::uint32_t body, const Box& last, std::uint32_t fewest_steps) {
  const Box& now = boxes_[body];
  Box& fat = fat_[body];
  fat = now;
  if (too_large(now) || too_large(last)) return;
  const double size = size_of(now);
  std::array<double, 3> down, up;
  double path = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    down[k] = last.low[k] - now.low[k];
    up[k] = now.high[k] - last.high[k];
    path = std::max({path, std::abs(down[k]), std::abs(up[k])});
  }
  if (path > hopeless * size) return;
  const double steps = fewest_steps + scatter(body, steps_) % (most_ahead + 1 - fewest_steps);
  for (std::size_t k = 0; k < 3; ++k) {
    const double margin = thin * (now.high[k] - now.low[k]);
    fat.low[k] -= margin + std::clamp(steps * down[k], 0.0, widest * size);
    fat.high[k] += margin + std::clamp(steps * up[k], 0.0, widest * size);
  }
}

}  // namespace polhode::broad
