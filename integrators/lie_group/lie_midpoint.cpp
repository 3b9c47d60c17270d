// SPDX-License-Identifier: BSD-3-Clause
// Implicit midpoint rule with the exponential: the momentum half way, p̄ = p + h/2 w̄, turns the body by one exponential,
//   R̄ = R exp(θ/2), I θ/h = R̄ᵀ L̄, R' = R exp(θ), L' = L + h τ̄;
// for a free body y' = exp(−θ) y with θ = h I⁻¹ exp(−θ/2) y: it stays on its coadjoint orbit, the energy does not.
// The wrench and its power are those of the point half way (t + h/2, R̄, velocity θ/h).
// Source: the midpoint Lie algorithm of Austin, Krishnaprasad & Wang, Almost Poisson integration of rigid body systems,
// J. Comput. Phys. 107 (1993), with the exponential, as Krysl writes it: Explicit momentum-conserving integrator for
// dynamics of rigid bodies approximating the midpoint Lie algorithm, Int. J. Numer. Methods Eng. 63 (2005).
#include "integrators/lie_group/midpoint_step.hpp"

namespace polhode::inline integrators {

template <class System>
using LieMidpoint = MidpointStep<System, TwistRule::middle>;

IntegratorEntry lie_midpoint() {
  IntegratorEntry entry =
      fixed_step<LieMidpoint>({.name = "lie_midpoint",
                               .family = "Lie group",
                               .summary = "implicit midpoint rule for the momentum, turning by one exponential",
                               .order = 2,
                               .implicit = true,
                               .lie_group = true,
                               .symmetric = true,
                               .conserves_momentum = true,
                               .conserves_casimir = true});
  entry.refusal = needs_the_gyroscopic_term;
  return entry;
}

}  // namespace polhode
