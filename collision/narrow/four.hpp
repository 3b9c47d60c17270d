// SPDX-License-Identifier: BSD-3-Clause
// Three numbers side by side in a register of four; the last number is stored twice.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

#include "core/math/linear_algebra.hpp"

// GCC warns about the calling convention of such vectors on processors with narrower registers. They are passed within
// one file only.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace polhode::inline collision::inline narrow {

using Four [[gnu::vector_size(32)]] = double;
using FourBits [[gnu::vector_size(32)]] = std::int64_t;

inline Four four(const double* numbers) {
  Four x;
  std::memcpy(&x, numbers, sizeof x);
  return x;
}
inline Four three(const Vector3<double>& x) { return Four{x[0], x[1], x[2], x[2]}; }
inline Four all(double x) { return Four{x, x, x, x}; }
inline Four absolute(Four x) {
  constexpr std::int64_t magnitude = 0x7fffffffffffffff;
  return Four(FourBits(x) & FourBits{magnitude, magnitude, magnitude, magnitude});
}
inline Four next(Four x) { return __builtin_shufflevector(x, x, 1, 2, 0, 0); }
inline Four after_next(Four x) { return __builtin_shufflevector(x, x, 2, 0, 1, 1); }
inline Four larger(Four a, Four b) { return a > b ? a : b; }
inline Four smaller(Four a, Four b) { return a < b ? a : b; }
/// The largest of the four numbers.
inline double highest(Four x) {
  const Four pairs = larger(x, __builtin_shufflevector(x, x, 2, 3, 0, 1));
  return std::max(pairs[0], pairs[1]);
}
/// Bit k is the k-th truth value.
inline std::uint32_t bits(FourBits truth) {
#ifdef __AVX__
  return std::uint32_t(_mm256_movemask_pd(__m256d(truth)));
#else
  return std::uint32_t((truth[0] & 1) | (truth[1] & 2) | (truth[2] & 4) | (truth[3] & 8));
#endif
}
inline void put(Four x, double* numbers) { std::memcpy(numbers, &x, sizeof x); }
inline double largest(Four x) { return std::max(std::max(x[0], x[1]), x[2]); }

}  // namespace polhode::collision::narrow
