// SPDX-License-Identifier: BSD-3-Clause
// Draws the bodies, one call for each surface, and their shadows on the floors.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/surface_mesh.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

/// A body in the layout of the vertex buffer: pose relative to the eye, and colour.
struct BodyInstance {
  Matrix3<float> rotation;
  Vector3<float> position;
  Colour colour;
  float emphasis = 0;  ///< emphasis; 1: edges are drawn stronger
};

class BodyPass {
 public:
  explicit BodyPass(const std::vector<study::Surface>& surfaces);

  float radius(std::size_t surface) const { return surfaces_[surface]->radius; }
  /// Sets the bodies to draw from now on, by surface, sorted by their distance.
  void place(std::span<std::vector<BodyInstance>> instances);
  void draw(const ViewState& view, bool edges) const;
  /// Draws the shadows; call right after FloorPass::draw_floor, on the plane normal · x = offset. Shadows fade out at a
  /// height of `reach` (m) above the plane.
  void draw_shadows(const ViewState& view, const Vector3<double>& normal, double offset, double reach) const;

 private:
  struct OnCard {
    VertexArray vertices;
    float radius = 0;
    std::size_t instances = 0;
  };
  std::vector<std::unique_ptr<OnCard>> surfaces_;
  Program solid_, shadow_;
};

}  // namespace polhode::viewer::drawing
