// SPDX-License-Identifier: BSD-3-Clause
// The elements of an inline SVG, with coordinates of one decimal: the same drawing has the same bytes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/report/drawing/view.hpp"

namespace polhode::study::inline report::inline drawing {

/// A coordinate: "12.3", "12", "0".
std::string coordinate(double x);

/// The commands of a path through the points: "M0 0L1 1Z".
std::string path_of(std::span<const PagePoint> points, bool closed);

/// Elements in drawing order. `style` is a list of attributes: `class="edge"`.
class Svg {
 public:
  void path(std::string_view commands, std::string_view style);
  void line(const PagePoint& from, const PagePoint& to, std::string_view style);
  void circle(const PagePoint& centre, double radius, std::string_view style);
  /// Text with its middle at a point.
  void text(const PagePoint& middle, std::string_view words, std::string_view style);

  const std::string& elements() const { return text_; }

 private:
  std::string text_;
};

}  // namespace polhode::study::report::drawing
