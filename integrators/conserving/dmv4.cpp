// SPDX-License-Identifier: BSD-3-Clause
// The discrete Moser–Veselov algorithm with moments of inertia modified up to h², in a Strang splitting with kicks:
// order 4 for free bodies, order 2 under forces. Source: Hairer & Vilmart, J. Phys. A 39 (2006) 13225.
#include "integrators/conserving/discrete_moser_veselov.hpp"

namespace polhode::inline integrators {

template <class System>
using Dmv4 = RotorSplitting<System, MoserVeselov<4>>;

IntegratorEntry dmv4() {
  return rotor_method<Dmv4>({.name = "dmv4",
                             .family = "conserving",
                             .summary = "kick, discrete Moser-Veselov with moments prepared to h^2, kick",
                             .order = 2,
                             .free_order = 4,
                             .implicit = true,
                             .lie_group = true,
                             .symmetric = true,
                             .conserves_energy = true,
                             .conserves_momentum = true,
                             .conserves_casimir = true});
}

}  // namespace polhode::integrators
