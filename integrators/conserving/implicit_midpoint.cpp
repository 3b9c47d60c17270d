// SPDX-License-Identifier: BSD-3-Clause
// The implicit midpoint rule y' = y + h f(t + h/2, (y + y')/2), the Gauss method of one stage.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 and IV.2.
#include "integrators/conserving/collocation.hpp"

namespace polhode::inline integrators {

template <class System>
using ImplicitMidpoint = GaussMethod<System, 1>;

IntegratorEntry implicit_midpoint() {
  return gauss_method<ImplicitMidpoint, 1>(
      {.name = "implicit_midpoint",
       .family = "conserving",
       .summary = "y' = y + h f(t + h/2, (y + y')/2)",
       .equation = R"(Z &= \tfrac12 h\,f\bigl(t_n + \tfrac12 h,\; y_n + Z\bigr), \quad y_{n+1} = y_n + 2 Z \\
\text{that is,}\quad y_{n+1} &= y_n + h\,f\bigl(t_n + \tfrac12 h,\; \tfrac12 (y_n + y_{n+1})\bigr))",
       .sources = {"hairerLubichWanner2006", "hairerWanner1996"},
       .order = 2,
       .implicit = true,
       .conserves_quadratics = true,
       .symmetric = true});
}

}  // namespace polhode::integrators
