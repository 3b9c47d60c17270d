// SPDX-License-Identifier: BSD-3-Clause
// The exact free rotor between two kicks of h/2: exact for free bodies, order 2 under forces.
// Source: Celledoni, Fassò, Säfström & Zanna, SIAM J. Sci. Comput. 30 (2008) 2084, section 4.
#include "integrators/conserving/exact_rotor.hpp"

namespace polhode::inline integrators {

IntegratorEntry exact_rotor() {
  return exact_rotor_method<ExactRotorMethod>({.name = "exact_rotor",
                                               .family = "conserving",
                                               .summary = "kick, the exact torque-free motion, kick",
                                               .order = 2,
                                               .free_order = Declaration::exact_order,
                                               .lie_group = true,
                                               .symplectic = true,
                                               .symmetric = true,
                                               .conserves_energy = true,
                                               .conserves_momentum = true,
                                               .conserves_casimir = true});
}

}  // namespace polhode::integrators
