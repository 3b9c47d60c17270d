// SPDX-License-Identifier: BSD-3-Clause
// The reactions of all joints at one state.
#pragma once

#include <vector>

#include "core/system/system.hpp"

namespace polhode::inline core::inline system {

/// The reaction of each joint on its first body: force (N), and torque (N m) about its anchor, world axes.
/// `multipliers` (N or N m, in the order of the rows) are those of a method; if it is empty, they follow from the state
/// by the index-1 form.
template <class S>
std::vector<Wrench<S>> joint_reactions(const System<S>& system, S t, const VectorX<S>& y,
                                       const VectorX<S>& multipliers = {});

}  // namespace polhode::core::system
