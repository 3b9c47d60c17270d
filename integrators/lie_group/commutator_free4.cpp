// SPDX-License-Identifier: BSD-3-Clause
// Commutator-free method of order 4 with four stages and five exponentials:
//   q_2 = q ⊕ ½ h ξ_1,  q_3 = q ⊕ ½ h ξ_2,  q_4 = q_2 ⊕ h (ξ_3 − ½ ξ_1),
//   q' = q ⊕ h/12 (3 ξ_1 + 2 ξ_2 + 2 ξ_3 − ξ_4) ⊕ h/12 (−ξ_1 + 2 ξ_2 + 2 ξ_3 + 3 ξ_4).
// Source: Celledoni, Marthinsen & Owren, Commutator-free Lie group methods, Future Gener. Comput. Syst. 19 (2003).
#include "integrators/lie_group/stage.hpp"

namespace polhode::inline integrators {

template <class System>
class CommutatorFree4 {
 public:
  static_assert(LieGroup<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit CommutatorFree4(const System& system)
      : k1_(system),
        k2_(system),
        k3_(system),
        k4_(system),
        point_(system.zero()),
        second_(system.zero()),
        step_(system.zero_tangent()) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2);
    k1_.evaluate(system, t, y);
    second_ = y;
    step_ = half * k1_.twist();
    LieStage<System>::retract(system, step_, second_);
    k1_.add_to(system, half, second_);
    k2_.evaluate(system, t + half, second_);
    point_ = y;
    step_ = half * k2_.twist();
    LieStage<System>::retract(system, step_, point_);
    k2_.add_to(system, half, point_);
    k3_.evaluate(system, t + half, point_);
    step_ = h * k3_.twist() - half * k1_.twist();
    LieStage<System>::retract(system, step_, second_);
    k3_.add_to(system, h, second_);
    k1_.add_to(system, -half, second_);
    k4_.evaluate(system, t + h, second_);

    const S twelfth = h / S(12);
    step_ = twelfth * (S(3) * k1_.twist() + S(2) * (k2_.twist() + k3_.twist()) - k4_.twist());
    LieStage<System>::retract(system, step_, y);
    step_ = twelfth * (S(2) * (k2_.twist() + k3_.twist()) + S(3) * k4_.twist() - k1_.twist());
    LieStage<System>::retract(system, step_, y);
    k1_.add_to(system, h / S(6), y);
    k2_.add_to(system, h / S(3), y);
    k3_.add_to(system, h / S(3), y);
    k4_.add_to(system, h / S(6), y);
  }

 private:
  LieStage<System> k1_, k2_, k3_, k4_;
  Flat point_, second_;
  typename System::Tangent step_;
};

IntegratorEntry commutator_free4() {
  return fixed_step<CommutatorFree4>(
      {.name = "commutator_free4",
       .family = "Lie group",
       .summary = "Celledoni, Marthinsen & Owren: the classical tableau by exponentials without commutators",
       .equation = R"(\xi_i &= \xi(q_i, v_i), \quad \dot v_i = \dot v(t_n + c_i h, q_i, v_i), \quad
  c = \bigl(0, \tfrac12, \tfrac12, 1\bigr) \\
q_1 &= q_n, \quad q_2 = q_n \oplus \tfrac12 h\,\xi_1, \quad q_3 = q_n \oplus \tfrac12 h\,\xi_2, \quad
  q_4 = q_2 \oplus h\,\bigl(\xi_3 - \tfrac12 \xi_1\bigr) \\
v_1 &= v_n, \quad v_2 = v_n + \tfrac12 h\,\dot v_1, \quad v_3 = v_n + \tfrac12 h\,\dot v_2, \quad
  v_4 = v_n + h\,\dot v_3 \\
q_{n+1} &= q_n \oplus \tfrac1{12} h\,(3 \xi_1 + 2 \xi_2 + 2 \xi_3 - \xi_4)
  \oplus \tfrac1{12} h\,(-\xi_1 + 2 \xi_2 + 2 \xi_3 + 3 \xi_4) \\
v_{n+1} &= v_n + \tfrac16 h\,(\dot v_1 + 2 \dot v_2 + 2 \dot v_3 + \dot v_4))",
       .sources = {"celledoni2003"},
       .order = 4,
       .evaluations_per_step = 4,
       .lie_group = true});
}

}  // namespace polhode::integrators
