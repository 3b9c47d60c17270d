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
       .order = 3,
       .evaluations_per_step = 3,
       .lie_group = true});
}

}  // namespace polhode::integrators
