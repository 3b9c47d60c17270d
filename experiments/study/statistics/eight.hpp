// SPDX-License-Identifier: BSD-3-Clause
// Eight numbers side by side. Results are the same for every width of the SIMD registers.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace polhode::study::inline statistics::spectral {

using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;

/// Sets `eight` to the numbers from this one on. It is no result, since no register of every processor can return it.
inline void read(Eight& eight, const double* numbers) { std::memcpy(&eight, numbers, sizeof eight); }

/// The same, where only `count` numbers are left; where these are fewer than eight, zeros follow them.
inline void read(Eight& eight, const double* numbers, std::ptrdiff_t count) {
  if (count >= 8) return read(eight, numbers);
  eight = Eight{};
  std::memcpy(&eight, numbers, static_cast<std::size_t>(count) * sizeof(double));
}

/// Calls use(i, count), i = 0, 8, …, for n numbers: `count` is the constant 8, and at last what is left. Calls with the
/// constant keep their numbers in registers.
template <class Use>
void for_each_eight(std::ptrdiff_t n, const Use& use) {
  std::ptrdiff_t i = 0;
  for (; i + 8 <= n; i += 8) use(i, std::integral_constant<std::ptrdiff_t, 8>());
  if (i < n) use(i, n - i);
}

/// The least multiple of eight that is not less than `count`.
constexpr std::ptrdiff_t in_eights(std::ptrdiff_t count) { return (count + 7) / 8 * 8; }

/// The sums of the numbers at even and at odd places, (s0 + s4) + (s2 + s6) and (s1 + s5) + (s3 + s7).
struct TwoTotals {
  double even = 0, odd = 0;
};

inline TwoTotals two_totals(const Eight& s) {
  const auto four = __builtin_shufflevector(s, s, 0, 1, 2, 3) + __builtin_shufflevector(s, s, 4, 5, 6, 7);
  const auto two = __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
  return {two[0], two[1]};
}

inline double total(const Eight& s) {
  const TwoTotals two = two_totals(s);
  return two.even + two.odd;
}

/// The sum, in eight sums.
inline double sum(const double* numbers, std::ptrdiff_t n) {
  Eight sums = {};
  for_each_eight(n, [&](std::ptrdiff_t i, auto count) {
    Eight next;
    read(next, numbers + i, count);
    sums += next;
  });
  return total(sums);
}

/// The largest distance of any of them from this number. NaN counts as nothing.
inline double largest_distance(const double* numbers, std::ptrdiff_t n, double from) {
  Eight largest = {};
  for_each_eight(n, [&](std::ptrdiff_t i, auto count) {
    Eight next = Eight{} + from;
    std::memcpy(&next, numbers + i, static_cast<std::size_t>(count) * sizeof(double));
    next -= from;
    next = next < 0 ? -next : next;
    largest = next > largest ? next : largest;
  });
  double size = 0;
  for (int i = 0; i < 8; ++i) size = largest[i] > size ? largest[i] : size;
  return size;
}
inline double largest_size(const double* numbers, std::ptrdiff_t n) { return largest_distance(numbers, n, 0); }

inline bool all_finite(const double* numbers, std::ptrdiff_t n) {
  Eight sums = {};
  for_each_eight(n, [&](std::ptrdiff_t i, auto count) {
    Eight next;
    read(next, numbers + i, count);
    sums += 0 * next;
  });
  return total(sums) == 0;
}

}  // namespace polhode::study::statistics::spectral
