// SPDX-License-Identifier: BSD-3-Clause
// The free-body update of Bullet. The gyroscopic equation I (Ω' − Ω) + h Ω' × IΩ' = 0 in the old body axes is
// approximated by one Newton step from Ω' = Ω:
//   (I + h (Ω* I − (IΩ)*)) ΔΩ = −h Ω × IΩ,  ω' = ω + R ΔΩ + h R I⁻¹ Rᵀ τ.
// Both increments of ω are computed from the old velocity, independently of each other. Then v' = v + h f/m,
// p' = p + h v', q' = exp(h ω') q, with normalization as part of the recipe. The work follows by the trapezoidal rule
// over the kick.
// Source: Bullet, btRigidBody::computeGyroscopicImpulseImplicit_Body and btTransformUtil::integrateTransform; Catto,
// Physics for Game Programmers: Numerical Methods, GDC 2015; Peters & Hsu, whose figures for Bullet it gives.
#include "integrators/recipes/engine_recipe.hpp"

namespace polhode::inline integrators {

template <class System>
class BulletStep {
 public:
  static_assert(LieGroup<System> && Splitting<System> && Measurable<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit BulletStep(const System& system) : spun_(system.zero()), step_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    spun_ = y;
    if (system.formulation().gyroscopic) {
      // Free flow with an identity rotation, so that only the momentum changes.
      system.free_flow(h, spun_, [](const auto& body, S dt, Vector3<S>& m) {
        spin_by_newton_step(body, dt, m);
        return identity_quaternion<S>();
      });
    }
    system.velocity_part(spun_) -= system.velocity_part(y);
    system.kick(t, h, y);
    system.velocity_part(y) += system.velocity_part(spun_);
    system.twist(y, step_);
    step_ *= h;
    system.retract(y, step_);
    system.project_flat(y.data());
  }

 private:
  Flat spun_;
  typename System::Tangent step_;
};

IntegratorEntry recipe_bullet() {
  return engine_recipe<BulletStep>(
      {.name = "recipe_bullet",
       .family = "engine recipe",
       .summary = "Bullet: one Newton step of the implicit gyroscopic equation, then q' = exp(h w') q, normalized",
       .equation =
           R"(\bigl(I + h\,(\hat\Omega_n I - \widehat{I \Omega_n})\bigr)\,\Delta\Omega
  &= -h\,\Omega_n \times I \Omega_n \\
\omega_{n+1} &= \omega_n + R_n\,\Delta\Omega + h\,R_n I^{-1} R_n^{\mathsf T}\,\tau(t_n, q_n, v_n) \\
\dot x_{n+1} &= \dot x_n + h\,f(t_n, q_n, v_n)/m, \quad x_{n+1} = x_n + h\,\dot x_{n+1} \\
\mathsf q_{n+1} &= \exp(h\,\omega_{n+1})\,\mathsf q_n, \text{ divided by its length})",
       .sources = {"bullet", "catto2015", "petersHsu2015"},
       .order = 1,
       .evaluations_per_step = 1,
       .lie_group = true,
       .normalizes = true});
}

}  // namespace polhode::integrators
