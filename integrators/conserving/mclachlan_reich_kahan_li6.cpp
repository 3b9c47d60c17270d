// SPDX-License-Identifier: BSD-3-Clause
// Kahan and Li's composition of nine parts of the three-rotation splitting with kicks: order 6, also under forces.
// Source: Kahan & Li, Math. Comp. 66 (1997) 1089.
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/mclachlan_reich.hpp"

namespace polhode::inline integrators {

template <class System>
using MclachlanReichKahanLi6 = Composition<System, MclachlanReich, KahanLi6>;

IntegratorEntry mclachlan_reich_kahan_li6() {
  return rotor_method<MclachlanReichKahanLi6>({.name = "mclachlan_reich_kahan_li6",
                                               .family = "conserving",
                                               .summary = "Kahan and Li's composition of nine parts of mclachlan_reich",
                                               .order = 6,
                                               .lie_group = true,
                                               .symplectic = true,
                                               .symmetric = true,
                                               .conserves_momentum = true,
                                               .conserves_casimir = true});
}

}  // namespace polhode::integrators
