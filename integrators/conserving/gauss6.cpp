// SPDX-License-Identifier: BSD-3-Clause
// The Gauss method of three stages, order 6 (Kuntzmann 1961, Butcher 1964).
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 and IV.2.
#include "integrators/conserving/collocation.hpp"

namespace polhode::inline integrators {

template <class System>
using Gauss6 = GaussMethod<System, 3>;

IntegratorEntry gauss6() {
  return additive_step<Gauss6>({.name = "gauss6",
                                .family = "conserving",
                                .summary = "the implicit Runge-Kutta method of Gauss with three stages",
                                .order = 6,
                                .implicit = true,
                                .conserves_quadratics = true,
                                .symmetric = true});
}

}  // namespace polhode::integrators
