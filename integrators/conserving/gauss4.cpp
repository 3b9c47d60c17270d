// SPDX-License-Identifier: BSD-3-Clause
// The Gauss method of two stages, order 4 (Hammer & Hollingsworth 1955).
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 and IV.2.
#include "integrators/conserving/collocation.hpp"

namespace polhode::inline integrators {

template <class System>
using Gauss4 = GaussMethod<System, 2>;

IntegratorEntry gauss4() {
  return gauss_method<Gauss4, 2>(
      {.name = "gauss4",
       .family = "conserving",
       .summary = "the implicit Runge-Kutta method of Gauss with two stages",
       .equation = R"(Z_i &= h \textstyle\sum_{j=1}^{2} a_{ij}\,f(t_n + c_j h,\; y_n + Z_j), \quad i = 1, 2 \\
y_{n+1} &= y_n + \sqrt3\,(Z_2 - Z_1), \quad c = \bigl(\tfrac12 - \tfrac{\sqrt3}6,\; \tfrac12 + \tfrac{\sqrt3}6\bigr) \\
(a_{ij}) &= \begin{pmatrix} \tfrac14 & \tfrac14 - \tfrac{\sqrt3}6 \\[3pt]
  \tfrac14 + \tfrac{\sqrt3}6 & \tfrac14 \end{pmatrix})",
       .sources = {"hammerHollingsworth1955", "hairerLubichWanner2006", "hairerWanner1996"},
       .order = 4,
       .implicit = true,
       .conserves_quadratics = true,
       .symmetric = true});
}

}  // namespace polhode::integrators
