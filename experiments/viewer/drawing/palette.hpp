// SPDX-License-Identifier: BSD-3-Clause
// The viewer's colours. Bodies: those of all drawings. Vectors and contacts: Okabe and Ito (Color universal design,
// 2008), which colour-blind readers can tell apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "experiments/study/scene/body_colours.hpp"

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
constexpr Colour fixed = {176, 180, 186};
constexpr Colour ink = {38, 44, 52};
constexpr Colour accent = {0, 90, 160};
constexpr std::array<Colour, 3> axes = {{{213, 94, 0}, {0, 148, 108}, {0, 114, 178}}};  // x, y, z
constexpr Colour angular_velocity = {230, 159, 0};
constexpr Colour angular_momentum = {160, 70, 140};
constexpr Colour contact = {38, 44, 52};
constexpr Colour normal = {213, 94, 0};
constexpr Colour depth = {204, 0, 102};
constexpr Colour reaction = {190, 20, 60};
constexpr Colour spring = {88, 96, 108};
constexpr Colour cell = {0, 114, 178};
constexpr Colour polhode = {200, 16, 80};
constexpr Colour inset = {206, 216, 228};
}  // namespace colours

/// The colour of a moving body, by its number.
constexpr Colour body_colour(std::size_t number) {
  const auto [red, green, blue] = study::body_colour(number);
  return {red, green, blue};
}

}  // namespace polhode::viewer::drawing
