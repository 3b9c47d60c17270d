// SPDX-License-Identifier: BSD-3-Clause
// The exact motion of a free body that one joint holds at a fixed point: it moves like a pinned body, whose exact
// rotations are known (core/exact/exact_rotation.hpp).
#pragma once

#include "core/exact/exact_path.hpp"
#include "core/exact/exact_rotation.hpp"

namespace polhode::inline core::inline exact {

struct JoinedMotion {
  ExactRotation rotation;  ///< rotation of the joined bodies; empty if none is known
  ExactPath path;          ///< path of their mass centre; empty if none is known
};

/// The motion of a body under uniform gravity whose only joint, to the world or a static body, is
///   a ball: a top about the anchor;
///   a hinge: a planar swing, if the axis is a principal axis about the anchor, perpendicular to gravity and to the arm
///   of the mass centre;
///   a distance from the mass centre: a spherical pendulum, which is a top without spin, while the body itself turns
///   freely.
/// Empty for other joints.
JoinedMotion joined_motion(const System<double>& system, std::size_t body);

}  // namespace polhode::core::exact
