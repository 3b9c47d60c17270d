// SPDX-License-Identifier: BSD-3-Clause
// Draws antialiased lines of any width, and dots, which are lines of length zero.
#pragma once

#include <span>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

struct LineInstance {
  Vector3<float> from, to;  ///< ends relative to the eye, m
  Colour colour_from, colour_to;
  float width = 1;  ///< pixels, times the view's line_scale
  float round = 0;  ///< shape of the ends; 1: half discs
};

class LinePass {
 public:
  LinePass();
  /// `through`: opacity, 0 to 1, of the parts of a line that are hidden by something in front of it. `lift`: m towards
  /// the eye, so that a mark on a surface is not half hidden by it.
  void draw(const ViewState& view, std::span<const LineInstance> lines, double through, double lift);

 private:
  Program program_;
  VertexArray lines_;
};

}  // namespace polhode::viewer::drawing
