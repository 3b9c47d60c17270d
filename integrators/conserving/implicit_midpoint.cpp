// SPDX-License-Identifier: BSD-3-Clause
// The implicit midpoint rule y' = y + h f(t + h/2, (y + y')/2), the Gauss method of one stage.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 and IV.2.
#include "integrators/conserving/collocation.hpp"

namespace polhode::inline integrators {

template <class System>
using ImplicitMidpoint = GaussMethod<System, 1>;

IntegratorEntry implicit_midpoint() {
  return additive_step<ImplicitMidpoint>({.name = "implicit_midpoint",
                                          .family = "conserving",
                                          .summary = "y' = y + h f(t + h/2, (y + y')/2)",
                                          .order = 2,
                                          .implicit = true,
                                          .conserves_quadratics = true,
                                          .symmetric = true});
}

}  // namespace polhode::integrators
