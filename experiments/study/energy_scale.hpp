// SPDX-License-Identifier: BSD-3-Clause
// Against what an energy drift is taken, and when it is beyond hope.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/system.hpp"

namespace polhode::study {

/// Relative energy drift beyond which a run is called off as diverged.
inline constexpr double hopeless_energy_drift = 1e6;

/// J, of a run that starts so: |E0|; where kinetic and potential energy cancel in it, the larger of the two; at rest at zero
/// potential 1 J.
inline double energy_scale_of(const Measurement<double>& start) {
  const double energy = std::abs(start.energy()), larger = std::max(std::abs(start.kinetic), std::abs(start.potential));
  const double scale = energy >= 1e-9 * larger ? energy : larger;
  return scale == 0 ? 1 : scale;
}

}  // namespace polhode::study
