// SPDX-License-Identifier: BSD-3-Clause
// Draws arrows: a round shaft and a cone, with the lighting of the bodies.
#pragma once

#include <span>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

struct ArrowInstance {
  Vector3<float> from;  ///< tail relative to the eye, m
  Vector3<float> way;   ///< way from tail to tip, m
  float radius = 0;     ///< radius of the shaft, reduced if the arrow is too short for it, m
  Colour colour;
};

class ArrowPass {
 public:
  ArrowPass();
  /// `through`: opacity, 0 to 1, of the parts of an arrow that are hidden by something in front of it.
  void draw(const ViewState& view, std::span<const ArrowInstance> arrows, double through);

 private:
  Program program_;
  VertexArray fine_, coarse_;
};

}  // namespace polhode::viewer::drawing
