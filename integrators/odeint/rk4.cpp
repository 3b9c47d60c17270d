// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's classical Runge–Kutta method with a fixed step.
// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.1; Boost.Odeint's runge_kutta4.
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <vector>

#include "integrators/odeint/fixed.hpp"

namespace polhode::inline integrators {
namespace {

template <class S>
using Rk4 = boost::numeric::odeint::runge_kutta4<std::vector<S>, S>;

}  // namespace

IntegratorEntry odeint_rk4() {
  return odeint_fixed<Rk4>(
      {.name = "odeint_rk4",
       .family = "Boost.Odeint",
       .summary = "the classical Runge-Kutta method of Boost.Odeint",
       .equation = R"(k_1 &= f(t_n, y_n), \quad k_2 = f\bigl(t_n + \tfrac12 h,\; y_n + \tfrac12 h\,k_1\bigr) \\
k_3 &= f\bigl(t_n + \tfrac12 h,\; y_n + \tfrac12 h\,k_2\bigr), \quad k_4 = f(t_n + h,\; y_n + h\,k_3) \\
y_{n+1} &= y_n + \tfrac16 h\,(k_1 + 2 k_2 + 2 k_3 + k_4))",
       .sources = {"kutta1901", "ahnertMulansky2011"},
       .order = 4,
       .evaluations_per_step = 4});
}

}  // namespace polhode::integrators
