// SPDX-License-Identifier: BSD-3-Clause
// Draws frames of a scene into a rectangle of the current framebuffer. It writes no text; labels() gives texts and
// their places.
#pragma once

#include <vector>

#include "experiments/viewer/drawing/body_pass.hpp"
#include "experiments/viewer/drawing/floor_pass.hpp"
#include "experiments/viewer/drawing/marks.hpp"
#include "experiments/viewer/drawing/polhode_pass.hpp"

namespace polhode::viewer::inline drawing {

/// One renderer for all runs of the same scene: they share its meshes and the scale of its arrows, so that they can be
/// compared. The framebuffer needs a depth buffer, and a stencil buffer for the shadows.
class Renderer {
 public:
  explicit Renderer(const study::Scene& scene);

  /// Throws std::invalid_argument unless the frame has as many bodies as move in the scene.
  void draw(const Frame& frame, const Camera& camera, const Look& look, const Rectangle& area, const Past& past = {});

  /// Names of the arrows of the last draw() with these arguments, and of the axes of the polhode's inset.
  std::vector<Label> labels(const Frame& frame, const Camera& camera, const Look& look, const Rectangle& area) const;
  /// The rectangle in which draw() puts the polhode.
  static Rectangle polhode_area(const Rectangle& area, const Look& look) {
    return PolhodePass::area(area, look.polhode_corner);
  }

 private:
  void place_bodies(const Frame& frame, const ViewState& view, const Look& look);
  void draw_polhode(const Frame& frame, const Camera& camera, const Look& look, const Rectangle& area,
                    const Past& past);
  std::optional<InertiaEllipsoid> ellipsoid(const Frame& frame, const Look& look) const;

  study::Scene scene_;
  Cast cast_;
  VectorScales scales_;
  BodyPass bodies_;
  FloorPass floor_;
  LinePass lines_;
  ArrowPass arrows_;
  PolhodePass polhode_;
  double polhode_reach_ = 1;  // reach at the last draw()
  Marks marks_;
  std::vector<Plane> planes_;                         // half-spaces
  std::vector<std::vector<BodyInstance>> instances_;  // instances of each surface
};

}  // namespace polhode::viewer::drawing
