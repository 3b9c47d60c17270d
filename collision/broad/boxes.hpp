// SPDX-License-Identifier: BSD-3-Clause
// Boxes as plain numbers, which is what the inner loops of the broad phases read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::broad {

struct Box {
  std::array<double, 3> low, high;
};

inline Box box_of(const Bounds& b) {
  return {{b.min().x(), b.min().y(), b.min().z()}, {b.max().x(), b.max().y(), b.max().z()}};
}

inline Bounds bounds_of(const Box& b) {
  return {Vector3<double>(b.low[0], b.low[1], b.low[2]), Vector3<double>(b.high[0], b.high[1], b.high[2])};
}

/// Without the branches that && would bring.
template <class... Truth>
constexpr bool all(Truth... truths) {
  return (int(truths) & ...) != 0;
}

/// Closed intervals. Without branches: most pairs that are asked about are neither clearly near nor clearly far.
inline bool overlap(const Box& a, const Box& b) {
  return all(a.low[0] <= b.high[0], b.low[0] <= a.high[0], a.low[1] <= b.high[1], b.low[1] <= a.high[1],
             a.low[2] <= b.high[2], b.low[2] <= a.high[2]);
}

inline bool contains(const Box& outer, const Box& inner) {
  return all(outer.low[0] <= inner.low[0], inner.high[0] <= outer.high[0], outer.low[1] <= inner.low[1],
             inner.high[1] <= outer.high[1], outer.low[2] <= inner.low[2], inner.high[2] <= outer.high[2]);
}

inline Box hull(const Box& a, const Box& b) {
  Box h;
  for (std::size_t k = 0; k < 3; ++k) {
    h.low[k] = std::min(a.low[k], b.low[k]);
    h.high[k] = std::max(a.high[k], b.high[k]);
  }
  return h;
}

/// The longest edge; infinite where an edge is.
inline double size_of(const Box& b) {
  return std::max({b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]});
}

/// Halved before the sum, which therefore stays finite for finite bounds; of a box without end on both sides, 0.
inline double centre(const Box& b, std::size_t axis) {
  const double c = 0.5 * b.low[axis] + 0.5 * b.high[axis];
  return std::isnan(c) ? 0 : c;
}

/// Asks memory for what is read soon. Broad phases are slow where they wait for it, and know beforehand what for.
template <class T>
void fetch(const T& soon) {
  constexpr std::size_t line = 64;
  const char* const begin = reinterpret_cast<const char*>(&soon);
  for (std::size_t at = 0; at < sizeof(T); at += line) __builtin_prefetch(begin + at);
  if (alignof(T) < line) __builtin_prefetch(begin + sizeof(T) - 1);
}

/// Throws std::invalid_argument where one has a NaN or ends before it begins.
void check(std::span<const Bounds> bounds);

/// Takes the bounds over, after a look at all of them: where check() throws, `boxes` are as they were.
void take(std::span<const Bounds> bounds, std::vector<Box>& boxes);

/// Once a list is nearly full, room for twice of what is there: a scene that goes on as it began allocates no more.
template <class T>
void leave_room(std::vector<T>& v, std::size_t at_least = 64) {
  if (v.capacity() >= at_least && v.size() <= v.capacity() / 4 * 3) return;
  v.reserve(std::max(2 * v.size(), at_least));
}

}  // namespace polhode::broad
