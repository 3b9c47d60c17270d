// SPDX-License-Identifier: BSD-3-Clause
// A picture as rows of pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace polhode::viewer::inline pictures {

/// Red, green and blue, one byte each; top row first, no padding.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  const std::uint8_t* pixel(int x, int y) const {
    return rgb.data() + 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
  }
};

}  // namespace polhode::viewer::pictures
