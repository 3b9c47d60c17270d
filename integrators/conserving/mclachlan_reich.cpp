// SPDX-License-Identifier: BSD-3-Clause
// The three-rotation splitting (McLachlan 1993, Reich 1994) with kicks: kick(h/2), free body over h, kick(h/2).
#include "integrators/conserving/mclachlan_reich.hpp"

namespace polhode::inline integrators {

IntegratorEntry mclachlan_reich() {
  return rotor_method<MclachlanReich>({.name = "mclachlan_reich",
                                       .family = "conserving",
                                       .summary = "kick, rotations about the axes 1 2 3 2 1, kick",
                                       .order = 2,
                                       .lie_group = true,
                                       .symplectic = true,
                                       .symmetric = true,
                                       .conserves_momentum = true,
                                       .conserves_casimir = true});
}

}  // namespace polhode::integrators
