// SPDX-License-Identifier: BSD-3-Clause
// The joint constraints of DART 6.12 (BallJointConstraint, WeldJointConstraint) on free bodies: erp 0.01, a diagonal
// larger by 1e-9 of itself, impulses together, then q' = exp(h ω') q. DART's users keep trees in reduced coordinates
// and close loops with these constraints; here every joint is one of them. Linear velocities are in world axes.
// Source: DART, dart/constraint/BallJointConstraint.cpp and JointConstraint.cpp.
#include "integrators/recipes/joint_impulses.hpp"

namespace polhode::inline integrators {
namespace {

/// The gyroscopic torque of the start.
void spin_explicitly(const BodyConstants<double>& body, double h, Vector3<double>& m) {
  m += h * m.cross(body.inverse_moments.cwiseProduct(m));
}

}  // namespace

IntegratorEntry recipe_dart_joints() {
  return joint_impulses(
      {.name = "recipe_dart_joints",
       .family = "engine recipe",
       .summary = "joint constraints of DART 6.12: impulses together, erp 0.01, then q' = exp(h w') q, normalized",
       .equation = impulse_equation(R"(I\,\Delta\Omega &= -h\,\Omega_n \times I \Omega_n)",
                                    R"(\bigl(A + 10^{-9} \operatorname{diag} A\bigr)\,p
  &= -G_n v^* - \tfrac{0.01}{h}\,g(q_n), \quad A = G_n M^{-1} G_n^{\mathsf T})",
                                    exponential_turn_equation),
       .sources = {"dart2018"}},
      {.erp = 0.01, .cfm_share = 1e-9, .together = true, .spin = &spin_explicitly});
}

}  // namespace polhode::integrators
