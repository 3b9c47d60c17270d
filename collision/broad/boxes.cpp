// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/boxes.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace polhode::inline collision::inline broad {
namespace {

bool good(const Bounds& b) {
  return all(b.min().x() <= b.max().x(), b.min().y() <= b.max().y(), b.min().z() <= b.max().z());
}

[[noreturn]] void refuse(std::size_t body, const Bounds& b) {
  const bool nan = b.min().hasNaN() || b.max().hasNaN();
  throw std::invalid_argument("broad phase: the bounds of body " + std::to_string(body) +
                              (nan ? " have a NaN in them; stop the motion where it diverges"
                                   : " end before they begin; give the lower corner first"));
}

}  // namespace

void check(std::span<const Bounds> bounds) {
  bool none_bad = true;
  for (const Bounds& b : bounds) none_bad &= good(b);
  if (!none_bad) {
    const auto bad = std::find_if_not(bounds.begin(), bounds.end(), good);
    refuse(static_cast<std::size_t>(bad - bounds.begin()), *bad);
  }
}

void take(std::span<const Bounds> bounds, std::vector<PlainBox>& boxes) {
  check(bounds);
  boxes.resize(bounds.size());
  for (std::size_t i = 0; i < bounds.size(); ++i) boxes[i] = box_of(bounds[i]);
}

}  // namespace polhode::collision::broad
