// SPDX-License-Identifier: BSD-3-Clause
// Suzuki's composition of five parts of the three-rotation splitting with kicks: order 4, also under forces.
// Source: Suzuki, Phys. Lett. A 146 (1990) 319.
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/mclachlan_reich.hpp"

namespace polhode::inline integrators {

template <class System>
using MclachlanReichSuzuki4 = Composition<System, MclachlanReich, Suzuki4>;

IntegratorEntry mclachlan_reich_suzuki4() {
  return rotor_method<MclachlanReichSuzuki4>({.name = "mclachlan_reich_suzuki4",
                                              .family = "conserving",
                                              .summary = "Suzuki's composition of five parts of mclachlan_reich",
                                              .order = 4,
                                              .lie_group = true,
                                              .symplectic = true,
                                              .symmetric = true,
                                              .conserves_momentum = true,
                                              .conserves_casimir = true});
}

}  // namespace polhode::integrators
