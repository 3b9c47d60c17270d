// SPDX-License-Identifier: BSD-3-Clause
// The discrete Moser–Veselov algorithm with moments of inertia modified up to h⁴, in a Strang splitting with kicks:
// order 6 for free bodies, order 2 under forces. Source: Hairer & Vilmart, J. Phys. A 39 (2006) 13225.
#include "integrators/conserving/discrete_moser_veselov.hpp"

namespace polhode::inline integrators {

template <class System>
using Dmv6 = RotorSplitting<System, MoserVeselov<6>>;

IntegratorEntry dmv6() {
  return rotor_method<Dmv6>({.name = "dmv6",
                             .family = "conserving",
                             .summary = "kick, discrete Moser-Veselov with moments prepared to h^4, kick",
                             .order = 2,
                             .free_order = 6,
                             .implicit = true,
                             .lie_group = true,
                             .symmetric = true,
                             .conserves_energy = true,
                             .conserves_momentum = true,
                             .conserves_casimir = true});
}

}  // namespace polhode::integrators
