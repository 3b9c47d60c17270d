// SPDX-License-Identifier: BSD-3-Clause
// The exact rotation of a body, recognised from the forces on it: the free top, the heavy symmetric top, the pendulum,
// and rotation about a fixed axis.
#pragma once

#include <functional>
#include <optional>

#include "core/exact/free_top.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline exact {

struct RotationAt {
  std::optional<Quaternion<double>> orientation;  ///< body to world; absent if only the angular velocity is known
  Vector3<double> angular_velocity;               ///< angular velocity, world axes, rad/s
  /// The same in body axes; absent unless the rotation is that of a top.
  std::optional<Vector3<double>> angular_velocity_body = std::nullopt;
};

/// The angular velocity of a body at the start, rad/s, body axes.
Vector3<double> start_omega_body(const BodyStart& start);

/// A rotation as a function of time (s).
using ExactRotation = std::function<RotationAt(double)>;

/// The exact rotation of a body by the full equations, with the gyroscopic term; empty if none is known.
///   free top (core/exact/free_top.hpp): no torque;
///   Lagrange's top, or a planar swing (core/exact/lagrange_top.hpp): uniform gravity on a pinned body, or one constant
///   force in the world at a point of the body;
///   rotation about one principal axis, I ω̇ = τ − c ω: ω along that axis, torques constant in the world or the body,
///   angular drag;
///   ω alone, unless its direction is constant: isotropic body, torques constant in the world, angular drag.
ExactRotation exact_rotation(const System<double>& system, std::size_t body);

/// The free top whose rotation this is, part of it; null if it is none.
const FreeTop* free_top_of(const ExactRotation& rotation);

}  // namespace polhode::core::exact
