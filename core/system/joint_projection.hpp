// SPDX-License-Identifier: BSD-3-Clause
// Projection of a state onto the equations of the joints, in the metric of the masses: of all states that satisfy them,
// the nearest one. Source: Hairer & Wanner, Solving Ordinary Differential Equations II, section VII.2.
#pragma once

#include "core/system/system.hpp"

namespace polhode::inline core::inline system {

/// Projects the configuration onto g(q) = 0 (Newton's method, to round-off) and then the velocity onto G v = 0, as the
/// formulation of the system requires. Does nothing without joints.
template <class S>
void project_joints(const System<S>& system, VectorX<S>& y);

/// Projects the configuration or the velocity, independently of the formulation.
template <class S>
void project_joint_positions(const System<S>& system, VectorX<S>& y);
template <class S>
void project_joint_velocities(const System<S>& system, VectorX<S>& y);

/// The motions of all bodies, static ones included.
template <class S>
std::vector<BodyMotion<S>> motions_of(const System<S>& system, const VectorX<S>& y);

}  // namespace polhode::core::system
