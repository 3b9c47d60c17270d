// SPDX-License-Identifier: BSD-3-Clause
// Draws arrows: a round shaft and a cone, lit as the bodies are.
#pragma once

#include <span>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

struct ArrowInstance {
  Vector3<float> from;  ///< m, from the eye
  Vector3<float> way;   ///< m, to the tip
  float radius = 0;     ///< m, of the shaft; less where the arrow is too short for it
  Colour colour;
};

class ArrowPass {
 public:
  ArrowPass();
  /// `through`: how much of an arrow shines through what is before it, 0 to 1.
  void draw(const ViewState& view, std::span<const ArrowInstance> arrows, double through);

 private:
  Program program_;
  VertexArray fine_, coarse_;
};

}  // namespace polhode::viewer
