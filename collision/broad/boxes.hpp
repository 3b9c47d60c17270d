// SPDX-License-Identifier: BSD-3-Clause
// Axis-aligned boxes as plain numbers, the form that the inner loops of the broad phases read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::inline collision::inline broad {

struct PlainBox {
  std::array<double, 3> low, high;
};

inline PlainBox box_of(const Bounds& b) {
  return {{b.min().x(), b.min().y(), b.min().z()}, {b.max().x(), b.max().y(), b.max().z()}};
}

inline Bounds bounds_of(const PlainBox& b) {
  return {Vector3<double>(b.low[0], b.low[1], b.low[2]), Vector3<double>(b.high[0], b.high[1], b.high[2])};
}

/// Evaluates both conditions without the branch of &&.
template <class... Truth>
constexpr bool all(Truth... truths) {
  return (int(truths) & ...) != 0;
}

/// True if two closed boxes overlap. Without branches: most pairs that are tested are neither clearly near nor clearly
/// far.
inline bool overlap(const PlainBox& a, const PlainBox& b) {
  return all(a.low[0] <= b.high[0], b.low[0] <= a.high[0], a.low[1] <= b.high[1], b.low[1] <= a.high[1],
             a.low[2] <= b.high[2], b.low[2] <= a.high[2]);
}

inline bool contains(const PlainBox& outer, const PlainBox& inner) {
  return all(outer.low[0] <= inner.low[0], inner.high[0] <= outer.high[0], outer.low[1] <= inner.low[1],
             inner.high[1] <= outer.high[1], outer.low[2] <= inner.low[2], inner.high[2] <= outer.high[2]);
}

inline PlainBox hull(const PlainBox& a, const PlainBox& b) {
  PlainBox h;
  for (std::size_t k = 0; k < 3; ++k) {
    h.low[k] = std::min(a.low[k], b.low[k]);
    h.high[k] = std::max(a.high[k], b.high[k]);
  }
  return h;
}

/// The longest edge (m); +inf if an edge is infinite.
inline double size_of(const PlainBox& b) {
  return std::max({b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]});
}

/// The centre. Each side is halved before the sum, so that the sum of finite bounds is finite. 0 for a box that is
/// infinite on both sides.
inline double centre(const PlainBox& b, std::size_t axis) {
  const double c = 0.5 * b.low[axis] + 0.5 * b.high[axis];
  return std::isnan(c) ? 0 : c;
}

/// Prefetches memory that is read soon.
template <class T>
void fetch(const T& soon) {
  constexpr std::size_t line = 64;
  const char* const begin = reinterpret_cast<const char*>(&soon);
  for (std::size_t at = 0; at < sizeof(T); at += line) __builtin_prefetch(begin + at);
  if (alignof(T) < line) __builtin_prefetch(begin + sizeof(T) - 1);
}

/// Throws std::invalid_argument if a box has a NaN, or an end before its beginning.
void check(std::span<const Bounds> bounds);

/// Checks all bounds, then copies them. If check() throws, `boxes` is unchanged.
void take(std::span<const Bounds> bounds, std::vector<PlainBox>& boxes);

/// Doubles the capacity of a list that is nearly full, so that a scene in a steady state allocates no more.
template <class T>
void leave_room(std::vector<T>& v, std::size_t at_least = 64) {
  if (v.capacity() >= at_least && v.size() <= v.capacity() / 4 * 3) return;
  v.reserve(std::max(2 * v.size(), at_least));
}

}  // namespace polhode::collision::broad
