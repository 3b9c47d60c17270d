// SPDX-License-Identifier: BSD-3-Clause
// The Strang splitting R(h/2) S(h) R(h/2) of a rotation R and a symmetric top S, between two kicks of h/2.
// Sources: Touma & Wisdom, Astron. J. 107 (1994) 1189; Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107 (1997)
// 5840.
#include "integrators/conserving/symmetric_rotor.hpp"

namespace polhode::inline integrators {

struct StrangScheme {
  template <class S>
  static void compose(auto&& rotation, auto&& symmetric_top) {
    rotation(S(0.5));
    symmetric_top(S(1));
    rotation(S(0.5));
  }
};

template <class System>
using SymmetricRotor2 = RotorSplitting<System, SymmetricRotor<StrangScheme>>;

IntegratorEntry symmetric_rotor2() {
  return rotor_method<SymmetricRotor2>(
      {.name = "symmetric_rotor2",
       .family = "conserving",
       .summary = "kick, R(h/2) S(h) R(h/2) of a rotation and a symmetric top, kick",
       .equation = kick_flow_kick(R"(\rho_h &= A_{h/2} \circ C_h \circ A_{h/2} \circ B_h \\
B_h:\ & R \leftarrow R\,\exp(h\,m/I_b), \quad I_a \le I_b \le I_c \\
A_h:\ & m \leftarrow \exp(-\alpha\,e_a)\,m, \quad R \leftarrow R\,\exp(\alpha\,e_a), \quad
  \alpha = h\,(1/I_a - 1/I_b)\,m_a \\
C_h:\ & m \leftarrow \exp(-\gamma\,e_c)\,m, \quad R \leftarrow R\,\exp(\gamma\,e_c), \quad
  \gamma = h\,(1/I_c - 1/I_b)\,m_c)"),
       .sources = {"toumaWisdom1994", "dullweber1997", "fasso2003"},
       .order = 2,
       .lie_group = true,
       .symplectic = true,
       .symmetric = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

}  // namespace polhode::integrators
