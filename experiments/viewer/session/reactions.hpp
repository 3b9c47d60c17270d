// SPDX-License-Identifier: BSD-3-Clause
// The reactions of joints at one state, for display.
#pragma once

#include <vector>

#include "core/system/system.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline session {

/// The reaction of each joint on its first body, world axes; none without joints. `multipliers` (N or N m) are those of
/// a method; if they are empty, they follow from the state.
std::vector<FrameReaction> reactions_of(const System<double>& system, const State<double>& state,
                                        const VectorX<double>& multipliers = {});

}  // namespace polhode::viewer::session
