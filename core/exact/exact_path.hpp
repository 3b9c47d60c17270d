// SPDX-License-Identifier: BSD-3-Clause
// Which exact solution the path of a mass centre has, told from its forces alone: projectile, linear oscillator, and
// Kepler's motion of two bodies.
#pragma once

#include <functional>

#include "core/exact/motion_at.hpp"
#include "core/system/system.hpp"

namespace polhode {

/// A path in world axes as a function of time (s).
using ExactPath = std::function<PathAt(double)>;

/// Of a body that is not pinned; empty if it has none that is known here:
///   constant forces, linear drag, and springs without rest length and dampers from the mass centre to points that are
///   fixed in the world                                    the linear oscillator (core/exact/linear_motion.hpp)
///   point gravity from one other body, free or static     Kepler's motion (core/exact/kepler_motion.hpp); beside it
///   only
///                                                         forces that accelerate both free bodies alike
ExactPath exact_path(const System<double>& system, std::size_t body);

}  // namespace polhode
