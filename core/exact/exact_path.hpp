// SPDX-License-Identifier: BSD-3-Clause
// The exact path of a mass centre, recognised from the forces on it: projectile, linear oscillator, Kepler's motion of
// two bodies.
#pragma once

#include <functional>

#include "core/exact/motion_at.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline exact {

/// A path in world axes as a function of time (s).
using ExactPath = std::function<PathAt(double)>;

/// The exact path of a body that is not pinned; empty if none is known.
///   linear oscillator (core/exact/linear_motion.hpp): constant forces, linear drag, and springs without rest length
///   and dampers from the mass centre to points fixed in the world;
///   Kepler's motion (core/exact/kepler_motion.hpp): point gravity from one other body, free or static; besides it only
///   forces that accelerate both free bodies alike.
ExactPath exact_path(const System<double>& system, std::size_t body);

}  // namespace polhode::core::exact
