// SPDX-License-Identifier: BSD-3-Clause
// Kahan and Li's composition of nine parts of the exact free rotor with kicks: order 6, also under forces.
// Source: Kahan & Li, Math. Comp. 66 (1997) 1089.
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/exact_rotor.hpp"

namespace polhode::inline integrators {

template <class System>
using ExactRotorKahanLi6 = Composition<System, ExactRotorMethod, KahanLi6>;

IntegratorEntry exact_rotor_kahan_li6() {
  return exact_rotor_method<ExactRotorKahanLi6>({.name = "exact_rotor_kahan_li6",
                                                 .family = "conserving",
                                                 .summary = "Kahan and Li's composition of nine parts of exact_rotor",
                                                 .order = 6,
                                                 .free_order = Declaration::exact_order,
                                                 .lie_group = true,
                                                 .symplectic = true,
                                                 .symmetric = true,
                                                 .conserves_energy = true,
                                                 .conserves_momentum = true,
                                                 .conserves_casimir = true});
}

}  // namespace polhode::integrators
