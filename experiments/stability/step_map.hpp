// SPDX-License-Identifier: BSD-3-Clause
// Linear theory, from the method itself: the map of one step over a linear system, and its spectral radius.
#pragma once

#include <optional>

#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::stability {

/// The largest modulus of the eigenvalues of the map (positions, velocities) → the same after one step of dt. Its
/// columns are differences of steps from displaced states, which for a linear map is exact but for rounding.
///
/// Absent where the mass centres do not obey a linear equation, a body turns, the method has a history or chooses its
/// steps, or a step fails.
std::optional<double> spectral_radius(const IntegratorEntry& method, const Problem& problem,
                                      const Formulation& formulation, double dt);

/// True when nothing turns and the accelerations of the mass centres are linear in positions and velocities (and
/// perhaps constant parts) at all times: tried on displaced states.
bool is_linear(const System<double>& system);

}  // namespace polhode::study
