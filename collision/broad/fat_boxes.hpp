// SPDX-License-Identifier: BSD-3-Clause
// Boxes enlarged by a margin, which need no update while the true box stays inside: this makes structures over moving
// bodies cheap to maintain (van den Bergen 1999; the dynamic trees of Bullet and Box2D). The margin reaches ahead by a
// number of steps of the mean motion of the body since its last fat box; a thin margin on all sides absorbs jitter.
// Bodies that move far in each step get no margin.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/broad/boxes.hpp"

namespace polhode::inline collision::inline broad {

class FatBoxes {
 public:
  /// Sets the true boxes of a step. Returns true for a new scene: everything must be built anew, and left() are all
  /// bodies. Otherwise left() are the bodies whose true box left its fat box; these have got a new one. Throws
  /// std::invalid_argument like check().
  bool update(std::span<const Bounds> bounds);

  std::size_t size() const { return fat_.size(); }
  const PlainBox& fat(std::uint32_t body) const { return fat_[body]; }
  const PlainBox& before(std::size_t k) const {
    return before_[k];
  }  ///< the fat box that left()[k] had; of a new scene none
  std::span<const std::uint32_t> left() const { return left_; }  ///< sorted
  bool has_left(std::uint32_t body) const { return has_left_[body] != 0; }

  /// True if the box is infinite, or so large that its surface area is not finite: such a body is kept out of trees.
  static bool too_large(const PlainBox& b) {
    constexpr double most = 1e75;
    return !all(b.low[0] > -most, b.low[1] > -most, b.low[2] > -most, b.high[0] < most, b.high[1] < most,
                b.high[2] < most);
  }

 private:
  /// Position of a body when it got its fat box.
  struct Origin {
    PlainBox box;
    std::uint32_t step;
  };

  void begin_scene(std::span<const Bounds> bounds);
  void renew(std::uint32_t body, const PlainBox& now, double fewest_steps);

  std::vector<PlainBox> fat_, before_,
      now_;  // boxes by number; for bodies that left: their old fat boxes, and their true boxes
  std::vector<Origin> origin_;
  std::vector<std::uint32_t> left_;
  std::vector<std::uint8_t> has_left_;
  std::uint32_t step_ = 0;
};

}  // namespace polhode::collision::broad
