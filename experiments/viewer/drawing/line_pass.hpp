// SPDX-License-Identifier: BSD-3-Clause
// Draws lines of any width, smooth at their edges, and dots: lines without length.
#pragma once

#include <span>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

struct LineInstance {
  Vector3<float> from, to;  ///< m, from the eye
  Colour colour_from, colour_to;
  float width = 1;  ///< pixels, times the view's line_scale
  float round = 0;  ///< 1: the ends are half discs
};

class LinePass {
 public:
  LinePass();
  /// `through`: how much of a line shines through what is before it, 0 to 1; `lift`: m towards the eye, so that a mark
  /// on a surface is not half within it.
  void draw(const ViewState& view, std::span<const LineInstance> lines, double through, double lift);

 private:
  Program program_;
  VertexArray lines_;
};

}  // namespace polhode::viewer
