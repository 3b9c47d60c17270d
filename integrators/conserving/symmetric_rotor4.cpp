// SPDX-License-Identifier: BSD-3-Clause
// Blanes and Moan's splitting S6 of order 4 of a rotation R and a symmetric top S, R(a1 h) S(b1 h) R(a2 h) … R(a1 h)
// with six S and seven R, between two kicks of h/2: order 4 for free bodies, order 2 under forces. Sources: Blanes &
// Moan, J. Comput. Appl. Math. 142 (2002) 313, table 2; Fassò, J. Comput. Phys. 189 (2003) 527.
#include "integrators/conserving/symmetric_rotor.hpp"

namespace polhode::inline integrators {

struct BlanesMoanScheme {
  template <class S>
  static void compose(auto&& rotation, auto&& symmetric_top) {
    constexpr S a1 = S(0.0792036964311957L), a2 = S(0.353172906049774L), a3 = S(-0.0420650803577195L);
    constexpr S b1 = S(0.209515106613362L), b2 = S(-0.143851773179818L);
    constexpr S a4 = S(1) - S(2) * (a1 + a2 + a3), b3 = S(0.5) - (b1 + b2);
    constexpr S a[] = {a1, a2, a3, a4, a3, a2}, b[] = {b1, b2, b3, b3, b2, b1};
    for (int i = 0; i < 6; ++i) {
      rotation(a[i]);
      symmetric_top(b[i]);
    }
    rotation(a1);
  }
};

template <class System>
using SymmetricRotor4 = RotorSplitting<System, SymmetricRotor<BlanesMoanScheme>>;

IntegratorEntry symmetric_rotor4() {
  return rotor_method<SymmetricRotor4>(
      {.name = "symmetric_rotor4",
       .family = "conserving",
       .summary = "kick, Blanes and Moan's S6 of a rotation and a symmetric top, kick",
       .equation = kick_flow_kick(
           R"(\rho_h &= A_{a_1 h} \circ C_{b_1 h} \circ A_{a_2 h} \circ C_{b_2 h} \circ A_{a_3 h} \circ C_{b_3 h} \\
& \circ A_{a_4 h} \circ C_{b_3 h} \circ A_{a_3 h} \circ C_{b_2 h} \circ A_{a_2 h} \circ C_{b_1 h} \\
& \circ A_{a_1 h} \circ B_h \\
& a_1 = 0.0792036964311957, \quad a_2 = 0.353172906049774 \\
& a_3 = -0.0420650803577195 \\
& b_1 = 0.209515106613362, \quad b_2 = -0.143851773179818 \\
& a_4 = 1 - 2 (a_1 + a_2 + a_3), \quad b_3 = \tfrac12 - (b_1 + b_2) \\
B_h:\ & R \leftarrow R\,\exp(h\,m/I_b), \quad I_a \le I_b \le I_c \\
A_h:\ & m \leftarrow \exp(-\alpha\,e_a)\,m, \quad R \leftarrow R\,\exp(\alpha\,e_a), \quad
  \alpha = h\,(1/I_a - 1/I_b)\,m_a \\
C_h:\ & m \leftarrow \exp(-\gamma\,e_c)\,m, \quad R \leftarrow R\,\exp(\gamma\,e_c), \quad
  \gamma = h\,(1/I_c - 1/I_b)\,m_c)"),
       .sources = {"blanesMoan2002", "fasso2003", "toumaWisdom1994", "dullweber1997"},
       .order = 2,
       .free_order = 4,
       .lie_group = true,
       .symplectic = true,
       .symmetric = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

}  // namespace polhode::integrators
