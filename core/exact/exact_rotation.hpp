// SPDX-License-Identifier: BSD-3-Clause
// Which exact solution a body's rotation has, told from its forces alone: the free top, the heavy symmetric top and the
// pendulum, and turning about an axis that stays.
#pragma once

#include <functional>
#include <optional>

#include "core/system/system.hpp"

namespace polhode {

struct RotationAt {
  std::optional<Quaternion<double>> orientation;  ///< body to world; absent where the angular velocity alone is known
  Vector3<double> angular_velocity;               ///< rad/s, world
};
/// Of the time in s.
using ExactRotation = std::function<RotationAt(double)>;

/// That of the full equations, with the gyroscopic term; empty if it has none that is known here:
///   no torque                                             the free top (core/exact/free_top.hpp)
///   uniform gravity on a pinned body, or one constant
///   force in the world at a point of the body             Lagrange's top or a planar swing
///   (core/exact/lagrange_top.hpp) torques constant in world or body, and angular drag   about one principal axis, ω
///   along it: I ω̇ = τ − c ω torques constant in the world, drag, isotropic body   ω alone, unless it keeps its
///   direction
ExactRotation exact_rotation(const System<double>& system, std::size_t body);

}  // namespace polhode
