// SPDX-License-Identifier: BSD-3-Clause
// A state of one formulation as a state of another.
#pragma once

#include "core/system/system.hpp"

namespace polhode::viewer::inline session {

/// Writes a body into a state of this system: its orientation (the rotation where the chart is the matrix), its angular
/// state and, unless it is pinned, where it is and how fast.
void write_body(const System<double>& system, const BodySnapshot<double>& body, std::size_t i, VectorX<double>& y);

/// The same motion of the same problem in the formulation of another system. Numbers that both formulations have are
/// taken over to the bit, time and work among them.
State<double> converted(const System<double>& from, const State<double>& state, const System<double>& to);

}  // namespace polhode::viewer
