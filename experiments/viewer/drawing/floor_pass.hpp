// SPDX-License-Identifier: BSD-3-Clause
// Draws the background: its gradient, and half-spaces as grids that fade out.
#pragma once

#include <span>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

/// The plane normal · x = offset, world; the half-space is behind it.
struct Plane {
  Vector3<double> normal;
  double offset;
};

class FloorPass {
 public:
  FloorPass();

  void draw_background() const;
  /// Draws one of the planes, except where it is inside another half-space. The spacing of its lines is a power of ten
  /// of a metre, chosen by the camera's distance. The stencil is 1 where the plane is visible, else 0.
  void draw_floor(const ViewState& view, std::span<const Plane> planes, std::size_t shown);

 private:
  Program background_, floor_;
  VertexArray nothing_;  // without buffers: the shader computes corners from the number of the vertex
  VertexArray polygon_;
};

}  // namespace polhode::viewer::drawing
