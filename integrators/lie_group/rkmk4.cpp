// SPDX-License-Identifier: BSD-3-Clause
// Runge–Kutta–Munthe-Kaas method of order 4: the classical Runge–Kutta method for θ̇ = dexp⁻¹_θ ξ(q ⊕ θ), θ(0) = 0, in
// the Lie algebra,
//   θ_2 = h/2 k_1, θ_3 = h/2 k_2, θ_4 = h k_3, k_i = dexp⁻¹_{θ_i} ξ(q ⊕ θ_i), q' = q ⊕ h/6 (k_1 + 2 k_2 + 2 k_3 + k_4),
// with dexp⁻¹ in closed form. Source: Munthe-Kaas, High order Runge–Kutta methods on manifolds, Appl. Numer. Math. 29
// (1999).
#include "integrators/lie_group/stage.hpp"

namespace polhode::inline integrators {

template <class System>
class Rkmk4 {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit Rkmk4(const System& system)
      : k_(system),
        point_(system.zero()),
        sum_(system.zero()),
        theta_(system.zero_tangent()),
        eta_(system.zero_tangent()),
        turn_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2), sixth = h / S(6), third = h / S(3);
    k_.evaluate(system, t, y);
    eta_ = k_.twist();
    turn_ = sixth * eta_;
    sum_ = y;  // its orientation is updated at the end of the step
    k_.add_to(system, sixth, sum_);
    stage(system, t + half, half, y, third);
    stage(system, t + half, half, y, third);
    stage(system, t + h, h, y, sixth);
    y = sum_;
    LieStage<System>::retract(system, turn_, y);
  }

 private:
  /// Evaluates k of the next stage at θ = c times the last k, and adds it to the step with the weight b.
  void stage(const System& system, S t, S c, const Flat& y, S b) {
    theta_ = c * eta_;
    point_ = y;
    LieStage<System>::retract(system, theta_, point_);
    k_.add_to(system, c, point_);
    k_.evaluate(system, t, point_);
    system.dexp_inverse(theta_, k_.twist(), eta_);
    turn_ += b * eta_;
    k_.add_to(system, b, sum_);
  }

  LieStage<System> k_;
  Flat point_, sum_;
  typename System::Tangent theta_, eta_, turn_;
};

IntegratorEntry rkmk4() {
  return fixed_step<Rkmk4>(
      {.name = "rkmk4",
       .family = "Lie group",
       .summary = "Runge-Kutta-Munthe-Kaas: the classical tableau in the algebra, with the inverse of dexp",
       .equation =
           R"(\theta_1 &= 0, \quad \theta_2 = \tfrac12 h\,k_1, \quad \theta_3 = \tfrac12 h\,k_2, \quad
  \theta_4 = h\,k_3 \\
v_1 &= v_n, \quad v_2 = v_n + \tfrac12 h\,\dot v_1, \quad v_3 = v_n + \tfrac12 h\,\dot v_2, \quad
  v_4 = v_n + h\,\dot v_3 \\
k_i &= \operatorname{dexp}^{-1}_{\theta_i} \xi(q_n \oplus \theta_i, v_i), \quad
  \dot v_i = \dot v(t_n + c_i h,\; q_n \oplus \theta_i,\; v_i) \\
q_{n+1} &= q_n \oplus \tfrac16 h\,(k_1 + 2 k_2 + 2 k_3 + k_4), \quad c = \bigl(0, \tfrac12, \tfrac12, 1\bigr) \\
v_{n+1} &= v_n + \tfrac16 h\,(\dot v_1 + 2 \dot v_2 + 2 \dot v_3 + \dot v_4))",
       .sources = {"muntheKaas1999", "iserles2000"},
       .order = 4,
       .evaluations_per_step = 4,
       .lie_group = true});
}

}  // namespace polhode::integrators
