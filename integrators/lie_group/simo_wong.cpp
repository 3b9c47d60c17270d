// SPDX-License-Identifier: BSD-3-Clause
// Simo & Wong's ALGO_C1. The torque at the midpoint updates the world momentum. The mean of the old and new body
// angular velocity updates the orientation:
//   Λ' = Λ exp(θ), θ = h/2 (W + W'), Λ' J W' = Λ J W + h m(t + h/2, Λ exp(θ/2)).
// For m = 0, exp(θ) J W' = J W in body axes. Because exp(θ) θ = θ, (W + W')·J (W' − W) = 0, so that a free body
// conserves energy and momentum. Velocity-dependent wrenches and the power are evaluated at the velocity θ/h. Source:
// Simo & Wong, Unconditionally stable algorithms for rigid body dynamics that exactly preserve energy and momentum,
// Int. J. Numer. Methods Eng. 31 (1991).
#include "integrators/lie_group/midpoint_step.hpp"

namespace polhode::inline integrators {

template <class System>
using SimoWong = MidpointStep<System, TwistRule::end>;

IntegratorEntry simo_wong() {
  IntegratorEntry entry = fixed_step<SimoWong, Forms::many_bodies>(
      {.name = "simo_wong",
       .family = "Lie group",
       .summary = "ALGO_C1: spatial momentum by the torque half way, q' = q exp(h/2 (W + W'))",
       .equation = R"(\theta &= \tfrac12 h\,(\Omega_n + \Omega_{n+1}), \quad
  \bar\tau = \tau\bigl(t_n + \tfrac12 h,\; R_n \exp\bigl(\tfrac12 \theta\bigr),\; \theta/h\bigr) \\
R_{n+1} &= R_n \exp(\theta), \quad R_{n+1} I \Omega_{n+1} = R_n I \Omega_n + h\,\bar\tau \\
\dot x_{n+1} &= \dot x_n + h\,\bar f/m, \quad x_{n+1} = x_n + \tfrac12 h\,(\dot x_n + \dot x_{n+1}))",
       .sources = {"simoWong1991"},
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

}  // namespace polhode::integrators
