// SPDX-License-Identifier: BSD-3-Clause
// Whole numbers of any length for the exact judges. A double is a whole number times a power of two, so that sums and
// products of doubles are whole numbers of a small enough unit.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace polhode {

/// Numbers of up to 1024 bits lie in the object itself; longer ones are allocated.
using Whole =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<1024>, boost::multiprecision::et_off>;

template <class T>
using Three = std::array<T, 3>;
using Whole3 = Three<Whole>;

template <class T>
T dot(const Three<T>& a, const Three<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Three<T> cross(const Three<T>& a, const Three<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
Three<T> operator*(const Three<T>& a, const T& s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
template <class T>
Three<T> operator+(const Three<T>& a, const Three<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Three<T> operator-(const Three<T>& a, const Three<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Three<T> operator-(const Three<T>& a) {
  return {-a[0], -a[1], -a[2]};
}

inline Whole magnitude(const Whole& x) { return x < 0 ? Whole(-x) : x; }

/// The number to a few units of the last place; its size may be up to 2^16383.
inline long double rounded(const Whole& x) { return x.convert_to<long double>(); }
inline Three<long double> rounded(const Whole3& x) { return {rounded(x[0]), rounded(x[1]), rounded(x[2])}; }

inline constexpr int no_bits = 2000;  ///< number of a bit above the exponent of any double

/// The power of two in the last bit of x, or a smaller one; large where x is 0.
inline int last_bit(double x) {
  if (x == 0) return no_bits;
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent - 53;
}

template <class Doubles>
int last_bit_of_all(const Doubles& numbers, int least = no_bits) {
  for (const double x : numbers) least = std::min(least, last_bit(x));
  return least;
}

/// x 2^-unit, which is whole.
inline Whole whole(double x, int unit) {
  if (x == 0) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return Whole(static_cast<long long>(std::ldexp(mantissa, 53))) << (exponent - 53 - unit);
}

}  // namespace polhode
