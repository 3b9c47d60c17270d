// SPDX-License-Identifier: BSD-3-Clause
// Implicit midpoint rule with the exponential map. The momentum at the midpoint, p̄ = p + h/2 w̄, determines the
// rotation:
//   R̄ = R exp(θ/2), I θ/h = R̄ᵀ L̄, R' = R exp(θ), L' = L + h τ̄.
// For a free body with body momentum y, y' = exp(−θ) y with θ = h I⁻¹ exp(−θ/2) y. The body momentum stays on its
// coadjoint orbit; the energy is not conserved. Wrench and power are evaluated at the midpoint (t + h/2, R̄, velocity
// θ/h). Source: the midpoint Lie algorithm of Austin, Krishnaprasad & Wang, Almost Poisson integration of rigid body
// systems, J. Comput. Phys. 107 (1993), with the exponential map as in Krysl, Explicit momentum-conserving integrator
// for dynamics of rigid bodies approximating the midpoint Lie algorithm, Int. J. Numer. Methods Eng. 63 (2005).
#include "integrators/lie_group/midpoint_step.hpp"

namespace polhode::inline integrators {

template <class System>
using LieMidpoint = MidpointStep<System, TwistRule::middle>;

IntegratorEntry lie_midpoint() {
  IntegratorEntry entry = fixed_step<LieMidpoint, Forms::many_bodies>(
      {.name = "lie_midpoint",
       .family = "Lie group",
       .summary = "implicit midpoint rule for the momentum, turning by one exponential",
       .equation = R"(\bar R &= R_n \exp\bigl(\tfrac12 \theta\bigr), \quad
  \bar\tau = \tau\bigl(t_n + \tfrac12 h,\; \bar R,\; \theta/h\bigr) \\
\theta &= h\,I^{-1} \bar R^{\mathsf T} \bigl(L_n + \tfrac12 h\,\bar\tau\bigr) \\
R_{n+1} &= R_n \exp(\theta), \quad L_{n+1} = L_n + h\,\bar\tau \\
\dot x_{n+1} &= \dot x_n + h\,\bar f/m, \quad x_{n+1} = x_n + \tfrac12 h\,(\dot x_n + \dot x_{n+1}))",
       .sources = {"austin1993", "krysl2005"},
       .order = 2,
       .implicit = true,
       .lie_group = true,
       .symmetric = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
  entry.refusal = needs_the_gyroscopic_term;
  return entry;
}

}  // namespace polhode::integrators
