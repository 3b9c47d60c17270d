// SPDX-License-Identifier: BSD-3-Clause
// The viewer's colours. Bodies: Paul Tol's "light" qualitative scheme (Colour schemes, SRON technical note, 2021).
// Vectors and contacts: Okabe and Ito (Color universal design, 2008). Colour-blind readers can tell the colours of both
// apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace polhode::viewer::inline drawing {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
  bool operator==(const Colour&) const = default;
};

constexpr Colour with_alpha(Colour c, double alpha) {
  c.alpha = std::uint8_t(alpha < 0 ? 0 : alpha > 1 ? 255 : 255 * alpha + 0.5);
  return c;
}

/// Linear interpolation from a to b; `share` from 0 to 1.
constexpr Colour mix(Colour a, Colour b, double share) {
  const auto one = [share](std::uint8_t x, std::uint8_t y) { return std::uint8_t(x + (double(y) - x) * share + 0.5); };
  return {one(a.red, b.red), one(a.green, b.green), one(a.blue, b.blue), one(a.alpha, b.alpha)};
}

namespace colours {
constexpr std::array<Colour, 8> bodies = {{{119, 170, 221},
                                           {238, 136, 102},
                                           {68, 187, 153},
                                           {238, 221, 136},
                                           {255, 170, 187},
                                           {153, 221, 255},
                                           {187, 204, 51},
                                           {170, 170, 0}}};
constexpr Colour fixed = {176, 180, 186};
constexpr Colour ink = {38, 44, 52};
constexpr Colour accent = {0, 90, 160};
constexpr std::array<Colour, 3> axes = {{{213, 94, 0}, {0, 148, 108}, {0, 114, 178}}};  // x, y, z
constexpr Colour angular_velocity = {230, 159, 0};
constexpr Colour angular_momentum = {160, 70, 140};
constexpr Colour contact = {38, 44, 52};
constexpr Colour normal = {213, 94, 0};
constexpr Colour depth = {204, 0, 102};
constexpr Colour spring = {88, 96, 108};
constexpr Colour cell = {0, 114, 178};
constexpr Colour polhode = {200, 16, 80};
constexpr Colour inset = {206, 216, 228};
}  // namespace colours

/// The colour of a moving body, by its number.
constexpr Colour body_colour(std::size_t number) { return colours::bodies[number % colours::bodies.size()]; }

}  // namespace polhode::viewer::drawing
