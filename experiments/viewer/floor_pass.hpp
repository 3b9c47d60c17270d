// SPDX-License-Identifier: BSD-3-Clause
// Draws what is behind the bodies: the background's gradient, and half-spaces as grids that fade out.
#pragma once

#include "experiments/viewer/gl_objects.hpp"
#include "experiments/viewer/view_state.hpp"

namespace polhode::viewer {

class FloorPass {
 public:
  FloorPass();

  void draw_background() const;
  /// The plane normal · x = offset. Its lines stand a power of ten of metres apart, by the camera's distance.
  void draw_floor(const ViewState& view, const Vector3<double>& normal, double offset) const;

 private:
  Program background_, floor_;
  VertexArray nothing_;  // corners come from the vertex's number
};

}  // namespace polhode::viewer
