// SPDX-License-Identifier: BSD-3-Clause
// Choices of what is drawn of a frame, and the regions of the picture.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/linear_algebra.hpp"
#include "experiments/viewer/drawing/palette.hpp"

namespace polhode::viewer::inline drawing {

enum class Corner { upper_left, upper_right, lower_left, lower_right };

struct Look {
  bool floor = true;    ///< half-spaces, drawn as grids
  bool shadows = true;  ///< shadows of bodies on the floor
  bool edges = true;    ///< edges of polyhedra
  bool springs = true;
  bool joints = true;     ///< anchors and axes of joints
  bool reactions = true;  ///< forces of joints on their first bodies, if the frame has them
  bool contacts = true;   ///< contact points, normals and depths, if the frame has them
  bool cells = true;      ///< cells of the broad phase, if the frame has them
  bool axes = false;      ///< x, y and z axes of each moving body
  bool angular_velocity = false;
  bool angular_momentum = false;
  bool trails = true;      ///< the trails passed to the renderer
  bool polhode = false;    ///< polhode of the selected body (else the first) in an inset, body axes
  bool poinsot = false;    ///< the inset in world axes, in which the ellipsoid rolls on the invariable plane
  double depth_scale = 1;  ///< factor by which contact depths are enlarged
  double line_scale = 1;   ///< factor for the widths of lines and dots, for screens and pictures with small pixels
  std::optional<std::size_t> selected;  ///< a moving body, whose edges are drawn stronger
  Corner polhode_corner = Corner::lower_right;
};

/// A rectangle of the framebuffer: pixels from its left and lower edge.
struct Rectangle {
  int left = 0, bottom = 0, width = 0, height = 0;
};

/// Past positions of a moving body's mass centre (m), oldest first.
struct Trail {
  std::size_t body = 0;
  std::vector<Vector3<double>> points;
};

/// Data drawn in addition to a frame.
struct Past {
  std::span<const Trail> trails;
  std::span<const Vector3<double>> polhode;  ///< ω (rad/s, body axes) of the selected body so far, oldest first
};

/// A text and its place in the picture; the renderer itself writes no text.
struct Label {
  std::string text;
  double right = 0, down = 0;  ///< pixels from the left and upper edge of the rectangle
  Colour colour;
};

}  // namespace polhode::viewer::drawing
