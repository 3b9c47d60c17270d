// SPDX-License-Identifier: BSD-3-Clause
// Eight numbers side by side. Results are the same for every width of the SIMD registers.
#pragma once

#include <cstddef>
#include <cstring>

namespace polhode::study::inline statistics::spectral {

using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;

/// Sets `eight` to the numbers from this one on. It is no result, since no register of every processor can return it.
inline void read(Eight& eight, const double* numbers) { std::memcpy(&eight, numbers, sizeof eight); }

/// The least multiple of eight that is not less than `count`.
constexpr std::ptrdiff_t in_eights(std::ptrdiff_t count) { return (count + 7) / 8 * 8; }

inline double total(const Eight& s) { return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])); }

}  // namespace polhode::study::statistics::spectral
