// SPDX-License-Identifier: BSD-3-Clause
// Linear stability from the method itself: the map of one step of a linear system, and its spectral radius.
#pragma once

#include <optional>

#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::stability {

/// Spectral radius of the map from (positions, velocities) to the same after one step dt (s): the largest modulus of
/// its eigenvalues. The columns of its matrix are differences of steps from displaced states, which are exact for a
/// linear map except for rounding.
///
/// Absent if the mass centres do not obey a linear equation, a body rotates, the method is a multistep method or
/// adaptive, or a step fails.
std::optional<double> spectral_radius(const IntegratorEntry& method, const Problem& problem,
                                      const Formulation& formulation, double dt);

/// True if no body rotates and the accelerations of the mass centres are affine in positions and velocities at all
/// times. This is tested at displaced states.
bool is_linear(const System<double>& system);

}  // namespace polhode::study::stability
