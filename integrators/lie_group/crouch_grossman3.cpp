// SPDX-License-Identifier: BSD-3-Clause
// Crouch–Grossman method of order 3 with three stages. Each stage and the step are products of exponentials of the ξ of
// earlier stages, applied to q in the order of the stages:
//   q_i = q ⊕ h a_i1 ξ_1 ⊕ h a_i2 ξ_2,  q' = q ⊕ h b_1 ξ_1 ⊕ h b_2 ξ_2 ⊕ h b_3 ξ_3,
// with c = (0, 3/4, 17/24), a_21 = 3/4, a_31 = 119/216, a_32 = 17/108, b = (13/51, −2/3, 24/17).
// Source: Crouch & Grossman, Numerical integration of ordinary differential equations on manifolds, J. Nonlinear Sci. 3
// (1993); coefficients from Owren & Marthinsen, Runge–Kutta methods adapted to manifolds, BIT 39 (1999).
#include "integrators/lie_group/stage.hpp"

namespace polhode::inline integrators {

template <class System>
class CrouchGrossman3 {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit CrouchGrossman3(const System& system)
      : k1_(system), k2_(system), k3_(system), point_(system.zero()), step_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    k1_.evaluate(system, t, y);
    point_ = y;
    move(system, h * (S(3) / S(4)), k1_, point_);
    k2_.evaluate(system, t + h * (S(3) / S(4)), point_);
    point_ = y;
    move(system, h * (S(119) / S(216)), k1_, point_);
    move(system, h * (S(17) / S(108)), k2_, point_);
    k3_.evaluate(system, t + h * (S(17) / S(24)), point_);
    move(system, h * (S(13) / S(51)), k1_, y);
    move(system, h * (S(-2) / S(3)), k2_, y);
    move(system, h * (S(24) / S(17)), k3_, y);
  }

 private:
  void move(const System& system, S c, LieStage<System>& k, Flat& y) {
    step_ = c * k.twist();
    LieStage<System>::retract(system, step_, y);
    k.add_to(system, c, y);
  }

  LieStage<System> k1_, k2_, k3_;
  Flat point_;
  typename System::Tangent step_;
};

IntegratorEntry crouch_grossman3() {
  return fixed_step<CrouchGrossman3>(
      {.name = "crouch_grossman3",
       .family = "Lie group",
       .summary = "Crouch-Grossman: a product of exponentials in every stage, Owren & Marthinsen's coefficients",
       .equation = R"(\xi_i &= \xi(q_i, v_i), \quad \dot v_i = \dot v(t_n + c_i h, q_i, v_i), \quad i = 1, 2, 3 \\
q_1 &= q_n, \quad q_2 = q_n \oplus \tfrac34 h\,\xi_1, \quad
  q_3 = q_n \oplus \tfrac{119}{216} h\,\xi_1 \oplus \tfrac{17}{108} h\,\xi_2 \\
v_1 &= v_n, \quad v_2 = v_n + \tfrac34 h\,\dot v_1, \quad
  v_3 = v_n + \tfrac{119}{216} h\,\dot v_1 + \tfrac{17}{108} h\,\dot v_2 \\
q_{n+1} &= q_n \oplus \tfrac{13}{51} h\,\xi_1 \oplus \bigl(-\tfrac23 h\,\xi_2\bigr) \oplus \tfrac{24}{17} h\,\xi_3 \\
v_{n+1} &= v_n + h\,\bigl(\tfrac{13}{51} \dot v_1 - \tfrac23 \dot v_2 + \tfrac{24}{17} \dot v_3\bigr),
  \quad c = \bigl(0, \tfrac34, \tfrac{17}{24}\bigr))",
       .sources = {"crouchGrossman1993", "owrenMarthinsen1999"},
       .order = 3,
       .evaluations_per_step = 3,
       .lie_group = true});
}

}  // namespace polhode::integrators
