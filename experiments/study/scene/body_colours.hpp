// SPDX-License-Identifier: BSD-3-Clause
// The colours of bodies: Paul Tol's "light" qualitative scheme (Colour schemes, SRON technical note, 2021).
// Colour-blind readers can tell them apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace polhode::study::inline scene {

/// Red, green and blue of a body by its place; they repeat.
constexpr std::array<std::uint8_t, 3> body_colour(std::size_t body) {
  constexpr std::array<std::array<std::uint8_t, 3>, 8> all = {{{119, 170, 221},
                                                               {238, 136, 102},
                                                               {68, 187, 153},
                                                               {238, 221, 136},
                                                               {255, 170, 187},
                                                               {153, 221, 255},
                                                               {187, 204, 51},
                                                               {170, 170, 0}}};
  return all[body % all.size()];
}

}  // namespace polhode::study::scene
