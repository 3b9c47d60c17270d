// SPDX-License-Identifier: BSD-3-Clause
// Yoshida's triple jump of the three-rotation splitting with kicks: order 4, also under forces.
// Source: Yoshida, Phys. Lett. A 150 (1990) 262.
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/mclachlan_reich.hpp"

namespace polhode::inline integrators {

template <class System>
using MclachlanReichYoshida4 = Composition<System, MclachlanReich, Yoshida4>;

IntegratorEntry mclachlan_reich_yoshida4() {
  return rotor_method<MclachlanReichYoshida4>({.name = "mclachlan_reich_yoshida4",
                                               .family = "conserving",
                                               .summary = "the triple jump (Yoshida) of mclachlan_reich",
                                               .order = 4,
                                               .lie_group = true,
                                               .symplectic = true,
                                               .symmetric = true,
                                               .conserves_momentum = true,
                                               .conserves_casimir = true});
}

}  // namespace polhode::integrators
