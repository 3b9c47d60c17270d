// SPDX-License-Identifier: BSD-3-Clause
// Yoshida's triple jump of the exact free rotor with kicks: order 4, also under forces.
// Source: Yoshida, Phys. Lett. A 150 (1990) 262.
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/exact_rotor.hpp"

namespace polhode::inline integrators {

template <class System>
using ExactRotorYoshida4 = Composition<System, ExactRotorMethod, Yoshida4>;

IntegratorEntry exact_rotor_yoshida4() {
  return exact_rotor_method<ExactRotorYoshida4>({.name = "exact_rotor_yoshida4",
                                                 .family = "conserving",
                                                 .summary = "the triple jump (Yoshida) of exact_rotor",
                                                 .order = 4,
                                                 .free_order = Declaration::exact_order,
                                                 .lie_group = true,
                                                 .symplectic = true,
                                                 .symmetric = true,
                                                 .conserves_energy = true,
                                                 .conserves_momentum = true,
                                                 .conserves_casimir = true});
}

}  // namespace polhode::integrators
