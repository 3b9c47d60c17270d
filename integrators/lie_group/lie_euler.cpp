// SPDX-License-Identifier: BSD-3-Clause
// Lie–Euler: q' = q ⊕ h ξ(q, v), v' = v + h v̇(t, q, v), with all rates at the old state. The new orientation is
// exp(hω) R in world axes and R exp(hΩ) in body axes. For momentum_world a free body has constant L and rotates by
// exp(hω), the coadjoint action.
// Source: Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group methods, Acta Numerica 9 (2000), section 3.
#include "integrators/lie_group/stage.hpp"

namespace polhode::inline integrators {

template <class System>
class LieEuler {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit LieEuler(const System& system) : stage_(system), step_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    stage_.evaluate(system, t, y);
    step_ = h * stage_.twist();
    LieStage<System>::retract(system, step_, y);
    stage_.add_to(system, h, y);
  }

 private:
  LieStage<System> stage_;
  typename System::Tangent step_;
};

IntegratorEntry lie_euler() {
  return fixed_step<LieEuler>({.name = "lie_euler",
                               .family = "Lie group",
                               .summary = "q' = q exp(h w), v' = v + h a(t, q, v), all from the old state",
                               .equation = R"(q_{n+1} &= q_n \oplus h\,\xi(q_n, v_n) \\
v_{n+1} &= v_n + h\,\dot v(t_n, q_n, v_n))",
                               .sources = {"iserles2000"},
                               .order = 1,
                               .evaluations_per_step = 1,
                               .lie_group = true});
}

}  // namespace polhode::integrators
