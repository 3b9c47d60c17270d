// SPDX-License-Identifier: BSD-3-Clause
// The values of an exact motion at one instant.
#pragma once

#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline exact {

/// Position and velocity of a point.
struct PathAt {
  Vector3<double> position;  ///< m
  Vector3<double> velocity;  ///< m/s
};

/// Orientation and angular velocity of a top; in Lanes those of a top in each lane.
template <class S>
struct TopAt {
  Quaternion<S> orientation;         ///< body to world
  Vector3<S> angular_velocity_body;  ///< angular velocity, body axes, rad/s
};

}  // namespace polhode::core::exact
