// SPDX-License-Identifier: BSD-3-Clause
// Suzuki's composition of five parts of the exact free rotor with kicks: order 4, also under forces.
// Source: Suzuki, Phys. Lett. A 146 (1990) 319.
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/exact_rotor.hpp"

namespace polhode::inline integrators {

template <class System>
using ExactRotorSuzuki4 = Composition<System, ExactRotorMethod, Suzuki4>;

IntegratorEntry exact_rotor_suzuki4() {
  return exact_rotor_method<ExactRotorSuzuki4>({.name = "exact_rotor_suzuki4",
                                                .family = "conserving",
                                                .summary = "Suzuki's composition of five parts of exact_rotor",
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
