// SPDX-License-Identifier: BSD-3-Clause
// What of a frame is shown, and where.
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
  bool floor = true;    ///< half-spaces, as grids
  bool shadows = true;  ///< of bodies on the floor
  bool edges = true;    ///< of polyhedra
  bool springs = true;
  bool contacts = true;  ///< points, normals and depths, where the frame has them
  bool cells = true;     ///< of the broad phase, where the frame has them
  bool axes = false;     ///< of each moving body: x, y, z
  bool angular_velocity = false;
  bool angular_momentum = false;
  bool trails = true;                   ///< those given
  bool polhode = false;                 ///< of the selected body (the first, if none is), in an inset: body axes
  bool poinsot = false;                 ///< the inset in world axes, where the ellipsoid rolls on the invariable plane
  double depth_scale = 1;               ///< depths are drawn so many times as long as they are
  double line_scale = 1;                ///< of the widths of lines and dots, for screens and pictures of fine pixels
  std::optional<std::size_t> selected;  ///< a moving body: its edges are drawn stronger
  Corner polhode_corner = Corner::lower_right;
};

/// A part of the framebuffer: pixels from its left and lower edge.
struct Rectangle {
  int left = 0, bottom = 0, width = 0, height = 0;
};

/// Where a moving body's mass centre has been, the oldest point first, m.
struct Trail {
  std::size_t body = 0;
  std::vector<Vector3<double>> points;
};

/// What is drawn beyond a frame.
struct Past {
  std::span<const Trail> trails;
  std::span<const Vector3<double>> polhode;  ///< rad/s, body axes: ω of the selected body so far, the oldest first
};

/// Text that belongs to a point of the picture, for whoever writes text.
struct Label {
  std::string text;
  double right = 0, down = 0;  ///< pixels from the rectangle's left and upper edge
  Colour colour;
};

}  // namespace polhode::viewer
