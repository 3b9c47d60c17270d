// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/fat_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace polhode::inline collision::inline broad {
namespace {

constexpr double fewest_ahead = 20, most_ahead = 32;  // steps that the room is for
constexpr double widest = 0.5;                        // reach ahead over the longest edge
constexpr double hopeless = 0.1;  // path of a step over the longest edge, above which room is of no use
constexpr double thin = 0.01;     // margin on all sides over the edge across it

constexpr std::size_t boxes_ahead = 64, bodies_ahead = 8;  // boxes and bodies by which memory is fetched ahead

/// A number from 0 to 1 that appears random, but is the same in every run.
double scatter(std::uint32_t body, std::uint32_t step) {
  std::uint32_t h = body * 0x9E3779B1u ^ step * 0x85EBCA77u;
  h = (h ^ h >> 15) * 0xC2B2AE3Du;
  return (h >> 8) * 0x1p-24;
}

}  // namespace

bool FatBoxes::update(std::span<const Bounds> bounds) {
  const std::size_t n = bounds.size();
  if (n != fat_.size()) {
    check(bounds);
    begin_scene(bounds);
    return true;
  }
  for (const std::uint32_t body : left_) has_left_[body] = 0;
  left_.resize(n);
  std::size_t count = 0;
  bool good = true;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t soon = std::min(i + boxes_ahead, n - 1);
    fetch(bounds[soon]);
    fetch(fat_[soon]);
    const PlainBox now = box_of(bounds[i]);
    good &= all(now.low[0] <= now.high[0], now.low[1] <= now.high[1], now.low[2] <= now.high[2]);
    if (contains(fat_[i], now)) continue;
    left_[count] = static_cast<std::uint32_t>(i);
    before_[count] = fat_[i];
    now_[count++] = now;
    fetch(origin_[i]);
  }
  left_.resize(good ? count : 0);
  if (!good) check(bounds);
  ++step_;
  // Many that leave together, as when a scene begins to move, shall not do so again.
  const double fewest = count > n / 2 ? 1 : fewest_ahead;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t body = left_[k], soon = left_[std::min(k + bodies_ahead, count - 1)];
    fetch(origin_[soon]);
    fetch(fat_[soon]);
    has_left_[body] = 1;
    renew(body, now_[k], fewest);
  }
  return false;
}

void FatBoxes::begin_scene(std::span<const Bounds> bounds) {
  const std::size_t n = bounds.size();
  step_ = 0;
  fat_.resize(n);
  before_.resize(n);
  now_.resize(n);
  origin_.resize(n);
  left_.resize(n);
  std::iota(left_.begin(), left_.end(), std::uint32_t(0));
  has_left_.assign(n, 1);
  for (const std::uint32_t body : left_) {
    const PlainBox now = box_of(bounds[body]);
    origin_[body] = {now, step_};
    renew(body, now, 1);
  }
}

void FatBoxes::renew(std::uint32_t body, const PlainBox& now, double fewest_steps) {
  const Origin last = origin_[body];
  origin_[body] = {now, step_};
  PlainBox& fat = fat_[body];
  fat = now;
  if (too_large(now) || too_large(last.box)) return;
  const double size = size_of(now), per_step = 1.0 / std::max(step_ - last.step, 1u);
  std::array<double, 3> down, up;
  double path = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    down[k] = (last.box.low[k] - now.low[k]) * per_step;
    up[k] = (now.high[k] - last.box.high[k]) * per_step;
    path = std::max({path, std::abs(down[k]), std::abs(up[k])});
  }
  if (path > hopeless * size) return;
  const double steps = fewest_steps + (most_ahead - fewest_steps) * scatter(body, step_);
  for (std::size_t k = 0; k < 3; ++k) {
    const double margin = thin * (now.high[k] - now.low[k]);
    fat.low[k] -= margin + std::clamp(steps * down[k], 0.0, widest * size);
    fat.high[k] += margin + std::clamp(steps * up[k], 0.0, widest * size);
  }
}

}  // namespace polhode::collision::broad
