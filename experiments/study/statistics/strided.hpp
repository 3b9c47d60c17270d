// SPDX-License-Identifier: BSD-3-Clause
// Numbers at equal distances in memory: a column of its own, or one lane of a column of lanes.
#pragma once

#include <cstddef>

namespace polhode::study::inline statistics {

struct Strided {
  const double* first = nullptr;
  std::size_t stride = 1;

  double operator[](std::size_t i) const { return first[i * stride]; }
};

}  // namespace polhode::study::statistics
