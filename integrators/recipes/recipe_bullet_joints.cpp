// SPDX-License-Identifier: BSD-3-Clause
// Bullet 3.24 with joints: sequential impulses, ten sweeps over the rows in their order, erp 0.2, cfm 0, without warm
// start, then q' = exp(h ω') q. Bullet itself works in single precision in Debian; this is the same in double.
// Source: Bullet, btSequentialImpulseConstraintSolver, btContactSolverInfo and btTransformUtil::integrateTransform.
#include "integrators/recipes/joint_impulses.hpp"

namespace polhode::inline integrators {

IntegratorEntry recipe_bullet_joints() {
  return joint_impulses(
      {.name = "recipe_bullet_joints",
       .family = "engine recipe",
       .summary = "Bullet 3.24: sequential impulses, 10 sweeps, erp 0.2, then q' = exp(h w') q, normalized",
       .equation = impulse_equation(
           R"(\bigl(I + h\,(\hat\Omega_n I - \widehat{I \Omega_n})\bigr)\,\Delta\Omega &= -h\,\Omega_n \times I \Omega_n)",
           R"(p &: \text{10 Gauss--Seidel sweeps from } 0 \text{ for } G_n M^{-1} G_n^{\mathsf T} p = -G_n v^* - \tfrac{0.2}{h}\,g(q_n))",
           exponential_turn_equation),
       .sources = {"bullet", "catto2015"}},
      {.spin = &spin_by_newton_step<BodyConstants<double>, double>}, 10);
}

}  // namespace polhode::integrators
