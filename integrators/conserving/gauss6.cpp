// SPDX-License-Identifier: BSD-3-Clause
// The Gauss method of three stages, order 6 (Kuntzmann 1961, Butcher 1964).
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.1.3 and IV.2.
#include "integrators/conserving/collocation.hpp"

namespace polhode::inline integrators {

template <class System>
using Gauss6 = GaussMethod<System, 3>;

IntegratorEntry gauss6() {
  return gauss_method<Gauss6, 3>(
      {.name = "gauss6",
       .family = "conserving",
       .summary = "the implicit Runge-Kutta method of Gauss with three stages",
       .equation = R"(Z_i &= h \textstyle\sum_{j=1}^{3} a_{ij}\,f(t_n + c_j h,\; y_n + Z_j), \quad i = 1, 2, 3 \\
y_{n+1} &= y_n + \tfrac53 Z_1 - \tfrac43 Z_2 + \tfrac53 Z_3, \quad
  c = \bigl(\tfrac12 - \tfrac{\sqrt{15}}{10},\; \tfrac12,\; \tfrac12 + \tfrac{\sqrt{15}}{10}\bigr) \\
(a_{ij}) &= \begin{pmatrix}
  \tfrac5{36} & \tfrac29 - \tfrac{\sqrt{15}}{15} & \tfrac5{36} - \tfrac{\sqrt{15}}{30} \\[3pt]
  \tfrac5{36} + \tfrac{\sqrt{15}}{24} & \tfrac29 & \tfrac5{36} - \tfrac{\sqrt{15}}{24} \\[3pt]
  \tfrac5{36} + \tfrac{\sqrt{15}}{30} & \tfrac29 + \tfrac{\sqrt{15}}{15} & \tfrac5{36} \end{pmatrix})",
       .sources = {"kuntzmann1961", "butcher1964", "hairerLubichWanner2006", "hairerWanner1996"},
       .order = 6,
       .implicit = true,
       .conserves_quadratics = true,
       .symmetric = true});
}

}  // namespace polhode::integrators
