// SPDX-License-Identifier: BSD-3-Clause
// The Gauss method of two stages, order 4 (Hammer & Hollingsworth 1955).
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 and IV.2.
#include "integrators/conserving/collocation.hpp"

namespace polhode::inline integrators {

template <class System>
using Gauss4 = GaussMethod<System, 2>;

IntegratorEntry gauss4() {
  return additive_step<Gauss4>({.name = "gauss4",
                                .family = "conserving",
                                .summary = "the implicit Runge-Kutta method of Gauss with two stages",
                                .order = 4,
                                .implicit = true,
                                .conserves_quadratics = true,
                                .symmetric = true});
}

}  // namespace polhode::integrators
