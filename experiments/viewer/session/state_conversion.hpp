// SPDX-License-Identifier: BSD-3-Clause
// Conversion of states between formulations.
#pragma once

#include "core/system/system.hpp"

namespace polhode::viewer::inline session {

/// Writes body i into a state of this system: its orientation (body.rotation if the chart is the matrix), its angular
/// state and, unless it is pinned, its position and velocity.
void write_body(const System<double>& system, const BodySnapshot<double>& body, std::size_t i, VectorX<double>& y);

/// The state in the formulation of the system `to`; both systems must be of the same problem. Numbers that both
/// formulations have, including time and work, are copied exactly.
State<double> converted(const System<double>& from, const State<double>& state, const System<double>& to);

}  // namespace polhode::viewer::session
