// SPDX-License-Identifier: BSD-3-Clause
// Simo & Wong's ALGO_C1: the momentum in the world moves by the torque half way, the orientation by the mean of the two
// body angular velocities,
//   Λ' = Λ exp(θ), θ = h/2 (W + W'), Λ' J W' = Λ J W + h m(t + h/2, Λ exp(θ/2)),
// so that exp(θ) J W' = J W in the body when m = 0: as exp(θ) leaves θ alone, (W + W')·J (W' − W) = 0 and the energy of
// a free body is kept with its momentum. Velocity-dependent wrenches, and the power, are taken at the velocity θ/h.
// Source: Simo & Wong, Unconditionally stable algorithms for rigid body dynamics that exactly preserve energy and
// momentum, Int. J. Numer. Methods Eng. 31 (1991).
#include "integrators/lie_group/midpoint_step.hpp"

namespace polhode::inline integrators {

template <class System>
using SimoWong = MidpointStep<System, TwistRule::end>;

IntegratorEntry simo_wong() {
  IntegratorEntry entry =
      fixed_step<SimoWong>({.name = "simo_wong",
                            .family = "Lie group",
                            .summary = "ALGO_C1: spatial momentum by the torque half way, q' = q exp(h/2 (W + W'))",
                            .order = 2,
                            .implicit = true,
                            .lie_group = true,
                            .symmetric = true,
                            .conserves_energy = true,
                            .conserves_momentum = true,
                            .conserves_casimir = true});
  entry.refusal = needs_the_gyroscopic_term;
  return entry;
}

}  // namespace polhode
