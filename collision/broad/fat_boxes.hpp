// SPDX-License-Identifier: BSD-3-Clause
// Boxes with a margin, which need no care while the true box stays within: what makes trees over moving bodies cheap to
// keep (van den Bergen 1999; Bullet's and Box2D's dynamic trees). The margin follows the motion: a few steps wide while
// bodies move by little, and none where each step carries them far.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad/boxes.hpp"

namespace polhode::broad {

class FatBoxes {
 public:
  /// The bodies of a step. True where it is a new scene, and everything is to be built anew; otherwise left() are the
  /// bodies whose true box left its fat one, and have a new one. Throws std::invalid_argument as take() does.
  bool update(std::span<const Bounds> bounds);

  std::size_t size() const { return boxes_.size(); }
  const Box& box(std::uint32_t body) const { return boxes_[body]; }   ///< as it is
  const Box& fat(std::uint32_t body) const { return fat_[body]; }
  const Box& before(std::size_t k) const { return before_[k]; }       ///< the fat box that left()[k] had
  std::span<const std::uint32_t> left() const { return left_; }

  /// Without bounds, or so far out that a surface area is no finite number: not for a tree.
  static bool too_large(const Box& b);

 private:
  double margin_of_motion() const;

  std::vector<Box> boxes_, next_, fat_, before_;
  std::vector<std::uint32_t> left_;
};

}  // namespace polhode::broad
