// SPDX-License-Identifier: BSD-3-Clause
// The lines, dots and arrows that stand for what of a frame is no body: springs, contacts, vectors, trails, cells.
#pragma once

#include <vector>

#include "experiments/viewer/drawing/arrow_pass.hpp"
#include "experiments/viewer/drawing/cast.hpp"
#include "experiments/viewer/drawing/line_pass.hpp"
#include "experiments/viewer/drawing/vector_scale.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline drawing {

/// The scales of vectors, kept from frame to frame.
struct VectorScales {
  VectorScale angular_velocity, angular_momentum;
  void see(const Frame& frame);
};

/// rad/s: below, a body rests, and neither ω nor L is drawn.
constexpr double least_angular_velocity = 1e-9;

/// Radii of the typical body: how long the longest arrows are; L reaches past an ω of the same direction.
constexpr double longest_angular_velocity = 1.6, longest_angular_momentum = 1.9;

/// From the mass centre to the tip of the arrow of ω or L, m; zero for a body that rests.
Vector3<double> angular_velocity_arrow(const FrameBody& body, const Cast& cast, const VectorScales& scales);
Vector3<double> angular_momentum_arrow(const FrameBody& body, const Cast& cast, const VectorScales& scales);
/// m, of the arrows that show a body's axes.
inline double axis_length(double body_radius) { return 1.35 * body_radius; }

struct Marks {
  std::vector<LineInstance> lines;   ///< hidden where something is before them
  std::vector<LineInstance> trails;  ///< faint there
  std::vector<LineInstance> over;    ///< so too
  std::vector<ArrowInstance> arrows;

  void clear();
  void add_springs(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view);
  void add_pivots(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view);
  void add_contacts(const Frame& frame, const Cast& cast, double depth_scale, const ViewState& view);
  void add_cells(const Frame& frame, const ViewState& view);
  void add_trails(std::span<const Trail> given, const ViewState& view);
  void add_axes(const Frame& frame, const Cast& cast, const ViewState& view);
  void add_arrow(const Vector3<double>& from, const Vector3<double>& way, double radius, Colour colour,
                 const ViewState& view);
};

}  // namespace polhode::viewer
