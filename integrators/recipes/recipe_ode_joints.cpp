// SPDX-License-Identifier: BSD-3-Clause
// The Open Dynamics Engine 0.16.2 with joints: erp 0.2, cfm 1e-10, the implicit gyroscopic torque of Lacoursière,
// q' = q + h/2 ω' q, normalized. `recipe_ode_step` (dWorldStep) solves for the impulses together;
// `recipe_ode_quickstep` (dWorldQuickStep) takes 20 sweeps of successive over-relaxation, 1.3, from p = 0, over the
// rows in their order, which ODE shuffles every eighth sweep. Source: ODE, step.cpp, quickstep.cpp and dxStepBody;
// Lacoursière, Stabilizing Gyroscopic Forces in Rigid Multibody Simulations, Umeå 2006.
#include "integrators/recipes/joint_impulses.hpp"

namespace polhode::inline integrators {
namespace {

/// (I − h m*) Ω' = m with the angular momentum m of the start.
void spin_by_momentum_of_start(const BodyConstants<double>& body, double h, Vector3<double>& m) {
  Matrix3<double> matrix = -h * skew<double>(m);
  matrix.diagonal() += body.moments;
  m = body.moments.cwiseProduct(Vector3<double>(matrix.inverse() * m));
}

constexpr const char* spin_equation =
    R"(\bigl(I - h\,\widehat{I \Omega_n}\bigr)\,(\Omega_n + \Delta\Omega) &= I\,\Omega_n)";

}  // namespace

IntegratorEntry recipe_ode_step() {
  return joint_impulses(
      {.name = "recipe_ode_step",
       .family = "engine recipe",
       .summary = "ODE 0.16.2, dWorldStep: impulses together, erp 0.2, cfm 1e-10, then q' = q + h/2 w' q, normalized",
       .equation = impulse_equation(spin_equation,
                                    R"(\bigl(G_n M^{-1} G_n^{\mathsf T} + \tfrac{10^{-10}}{h}\bigr)\,p
  &= -G_n v^* - \tfrac{0.2}{h}\,g(q_n))",
                                    first_order_turn_equation),
       .sources = {"openDynamicsEngine", "lacoursiere2006"}},
      {.cfm = 1e-10, .together = true, .first_order = true, .spin = &spin_by_momentum_of_start});
}

IntegratorEntry recipe_ode_quickstep() {
  return joint_impulses(
      {.name = "recipe_ode_quickstep",
       .family = "engine recipe",
       .summary = "ODE 0.16.2, dWorldQuickStep: 20 sweeps of SOR 1.3, erp 0.2, then q' = q + h/2 w' q, normalized",
       .equation = impulse_equation(spin_equation,
                                    R"(p &: \text{20 sweeps of SOR, 1.3, from } 0 \text{ for }
  \bigl(G_n M^{-1} G_n^{\mathsf T} + \tfrac{10^{-10}}{h}\bigr)\,p = -G_n v^* - \tfrac{0.2}{h}\,g(q_n))",
                                    first_order_turn_equation),
       .sources = {"openDynamicsEngine", "lacoursiere2006"}},
      {.cfm = 1e-10, .relaxation = 1.3, .first_order = true, .spin = &spin_by_momentum_of_start}, 20);
}

}  // namespace polhode::integrators
