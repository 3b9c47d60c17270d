// SPDX-License-Identifier: BSD-3-Clause
// Eight numbers side by side. Results are the same for every width of the SIMD registers.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <type_traits>

namespace polhode::study::inline statistics::spectral {

/// As many numbers as a SIMD register holds: more do not stay in registers. No result depends on how many these are.
#if defined(__AVX512F__)
inline constexpr std::ptrdiff_t wide = 8;
#elif defined(__AVX__)
inline constexpr std::ptrdiff_t wide = 4;
#else
inline constexpr std::ptrdiff_t wide = 2;
#endif
using Wide [[gnu::vector_size(wide * sizeof(double))]] = double;

struct TwoTotals {
  double even = 0, odd = 0;
};

class Eight {
 public:
  Eight() = default;
  Eight(double everywhere) {  // NOLINT: a number stands for eight of itself
    for (Wide& part : parts_) part = everywhere - Wide{};
  }

  void read(const double* numbers) {
    for (Wide& part : parts_) std::memcpy(&part, numbers, sizeof part), numbers += wide;
  }
  void write(double* numbers) const {
    for (const Wide& part : parts_) std::memcpy(numbers, &part, sizeof part), numbers += wide;
  }

  Eight& operator+=(const Eight& b) { return *this = *this + b; }
  Eight& operator-=(const Eight& b) { return *this = *this - b; }
  friend Eight operator+(const Eight& a, const Eight& b) {
    return each(a, b, [](const Wide& x, const Wide& y) -> Wide { return x + y; });
  }
  friend Eight operator-(const Eight& a, const Eight& b) {
    return each(a, b, [](const Wide& x, const Wide& y) -> Wide { return x - y; });
  }
  friend Eight operator*(const Eight& a, const Eight& b) {
    return each(a, b, [](const Wide& x, const Wide& y) -> Wide { return x * y; });
  }
  /// Place by place b where it is larger, else a.
  friend Eight larger(const Eight& a, const Eight& b) {
    return each(a, b, [](const Wide& x, const Wide& y) -> Wide { return y > x ? y : x; });
  }
  friend Eight abs(const Eight& a) {
    return each(a, a, [](const Wide& x, const Wide&) -> Wide { return x < 0 ? -x : x; });
  }

  /// The sums of the numbers at even and at odd places, (s0 + s4) + (s2 + s6) and (s1 + s5) + (s3 + s7).
  friend TwoTotals two_totals(const Eight& s) {
    using Two [[gnu::vector_size(2 * sizeof(double))]] = double;
    const auto two = [&](std::size_t i) -> Two {
      Two numbers;
      std::memcpy(&numbers, reinterpret_cast<const char*>(s.parts_) + i * sizeof numbers, sizeof numbers);
      return numbers;
    };
    const Two sums = (two(0) + two(2)) + (two(1) + two(3));
    return {sums[0], sums[1]};
  }

 private:
  template <class F>
  static Eight each(const Eight& a, const Eight& b, const F& f) {
    Eight c;
    for (std::size_t i = 0; i < std::size(c.parts_); ++i) c.parts_[i] = f(a.parts_[i], b.parts_[i]);
    return c;
  }

  Wide parts_[8 / wide];
};

/// The numbers from this one on, of which `count` are left; where these are fewer than eight, zeros follow them.
inline Eight eight(const double* numbers, std::ptrdiff_t count = 8) {
  Eight read;
  if (count >= 8) {
    read.read(numbers);
  } else {
    double padded[8] = {};
    std::memcpy(padded, numbers, static_cast<std::size_t>(count) * sizeof(double));
    read.read(padded);
  }
  return read;
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

inline double total(const Eight& s) {
  const TwoTotals two = two_totals(s);
  return two.even + two.odd;
}

/// The sum, in eight sums.
inline double sum(const double* numbers, std::ptrdiff_t n) {
  Eight sums = {};
  for_each_eight(n, [&](std::ptrdiff_t i, auto count) { sums += eight(numbers + i, count); });
  return total(sums);
}

/// The largest distance of any of them from this number. NaN counts as nothing.
inline double largest_distance(const double* numbers, std::ptrdiff_t n, double from) {
  Eight largest = {};
  const std::ptrdiff_t whole = n / 8 * 8;
  for (std::ptrdiff_t i = 0; i < whole; i += 8) largest = larger(largest, abs(eight(numbers + i) - from));
  double sizes[8], size = 0;
  largest.write(sizes);
  for (const double x : sizes) size = x > size ? x : size;
  for (std::ptrdiff_t i = whole; i < n; ++i) {
    const double x = std::abs(numbers[i] - from);
    size = x > size ? x : size;
  }
  return size;
}
inline double largest_size(const double* numbers, std::ptrdiff_t n) { return largest_distance(numbers, n, 0); }

inline bool all_finite(const double* numbers, std::ptrdiff_t n) {
  Eight sums = {};
  for_each_eight(n, [&](std::ptrdiff_t i, auto count) { sums += 0 * eight(numbers + i, count); });
  return total(sums) == 0;
}

}  // namespace polhode::study::statistics::spectral
