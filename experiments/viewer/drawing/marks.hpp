// SPDX-License-Identifier: BSD-3-Clause
// Lines, dots and arrows for everything in a frame that is not a body: springs, joints, contacts, vectors, trails,
// cells.
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
  VectorScale angular_velocity, angular_momentum, force;
  void see(const Frame& frame);
};

/// Rate, rad/s, below which a body is drawn without ω and L.
constexpr double least_angular_velocity = 1e-9;

/// Length of the longest arrows in radii of a typical body. The arrow of L is longer than that of ω, so that both are
/// visible if they are parallel.
constexpr double longest_angular_velocity = 1.6, longest_angular_momentum = 1.9;

/// Vector (m) from the mass centre to the tip of the arrow of ω or L; zero for a body at rest.
Vector3<double> angular_velocity_arrow(const BodySnapshot<double>& body, const Cast& cast, const VectorScales& scales);
Vector3<double> angular_momentum_arrow(const BodySnapshot<double>& body, const Cast& cast, const VectorScales& scales);
/// Length of the longest reactions in sizes of joints (Cast::joint_size).
constexpr double longest_reaction = 1.0;
/// Vector (m) from the joint to the tip of the arrow of its reaction; zero for one that is small beside the others.
Vector3<double> reaction_arrow(const FrameReaction& reaction, const Cast& cast, const VectorScales& scales);
/// Length (m) of the arrows of a body's axes.
inline double axis_length(double body_radius) { return 1.35 * body_radius; }

struct Marks {
  std::vector<LineInstance> lines;   ///< invisible where something is in front of them
  std::vector<LineInstance> trails;  ///< faint where something is in front of them
  std::vector<LineInstance> over;    ///< faint where something is in front of them
  std::vector<ArrowInstance> arrows;

  void clear();
  void add_springs(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view);
  void add_pivots(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view);
  void add_contacts(const Frame& frame, const Cast& cast, double depth_scale, const ViewState& view);
  /// Anchors with the line between them, axes, and the contact points of bodies that roll, if the frame has reactions.
  void add_joints(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view);
  void add_reactions(const Frame& frame, const Cast& cast, const VectorScales& scales, const ViewState& view);
  void add_cells(const Frame& frame, const ViewState& view);
  void add_trails(std::span<const Trail> given, const ViewState& view);
  void add_axes(const Frame& frame, const Cast& cast, const ViewState& view);
  void add_arrow(const Vector3<double>& from, const Vector3<double>& way, double radius, Colour colour,
                 const ViewState& view);
};

}  // namespace polhode::viewer::drawing
