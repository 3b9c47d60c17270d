// SPDX-License-Identifier: BSD-3-Clause
// Draws what is behind the bodies: the background's gradient, and half-spaces as grids that fade out.
#pragma once

#include <span>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

/// normal · x = offset, world; the half-space is behind it.
struct Plane {
  Vector3<double> normal;
  double offset;
};

class FloorPass {
 public:
  FloorPass();

  void draw_background() const;
  /// One of the planes, as far as it is not within another's half-space. Its lines stand a power of ten of metres
  /// apart, by the camera's distance. The stencil is 1 where it is seen, else 0.
  void draw_floor(const ViewState& view, std::span<const Plane> planes, std::size_t shown);

 private:
  Program background_, floor_;
  VertexArray nothing_;  // corners come from the vertex's number
  VertexArray polygon_;
};

}  // namespace polhode::viewer
