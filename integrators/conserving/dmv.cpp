// SPDX-License-Identifier: BSD-3-Clause
// The discrete Moser–Veselov algorithm in a Strang splitting with kicks: order 2 for free and for forced bodies.
#include "integrators/conserving/discrete_moser_veselov.hpp"

namespace polhode::inline integrators {

template <class System>
using Dmv = RotorSplitting<System, MoserVeselov<2>>;

IntegratorEntry dmv() {
  return rotor_method<Dmv>({.name = "dmv",
                            .family = "conserving",
                            .summary = "kick, h m* = R D - D R^T and m' = R^T m (discrete Moser-Veselov), kick",
                            .order = 2,
                            .implicit = true,
                            .lie_group = true,
                            .symplectic = true,
                            .symmetric = true,
                            .conserves_energy = true,
                            .conserves_momentum = true,
                            .conserves_casimir = true});
}

}  // namespace polhode::integrators
