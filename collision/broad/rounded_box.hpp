// SPDX-License-Identifier: BSD-3-Clause
// A box in single precision, half as large in memory. Rounding is monotonic: boxes that overlap also overlap when
// rounded, and rounded boxes that overlap by some margin do overlap. Cases in between must be decided with the boxes
// themselves.
#pragma once

#include <algorithm>
#include <limits>

#include "collision/broad/boxes.hpp"

namespace polhode::inline collision::inline broad {

/// Rounds to nearest; values beyond single precision become its largest number.
inline float rounded(double x) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -most, most));
}

struct RoundedBox {
  RoundedBox() = default;
  explicit RoundedBox(const PlainBox& b)
      : low{rounded(b.low[0]), rounded(b.low[1]), rounded(b.low[2])},
        high{rounded(b.high[0]), rounded(b.high[1]), rounded(b.high[2])} {}
  std::array<float, 3> low{}, high{};
};

inline bool may_overlap(const RoundedBox& a, const RoundedBox& b) {
  return all(a.low[0] <= b.high[0], b.low[0] <= a.high[0], a.low[1] <= b.high[1], b.low[1] <= a.high[1],
             a.low[2] <= b.high[2], b.low[2] <= a.high[2]);
}

inline bool surely_overlap(const RoundedBox& a, const RoundedBox& b) {
  return all(a.low[0] < b.high[0], b.low[0] < a.high[0], a.low[1] < b.high[1], b.low[1] < a.high[1],
             a.low[2] < b.high[2], b.low[2] < a.high[2]);
}

}  // namespace polhode::collision::broad
