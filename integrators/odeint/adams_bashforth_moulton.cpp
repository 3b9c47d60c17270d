// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's four-step Adams–Bashforth–Moulton method: the Adams–Bashforth formula of order 4 predicts, and the
// Adams–Moulton formula of order 4 corrects once with the rate at the prediction (PECE). The classical Runge–Kutta
// method takes the first three steps, and three after each projection or change of the step size. Sources: Hairer,
// Nørsett & Wanner, Solving Ordinary Differential Equations I, III.1; Boost.Odeint's adams_bashforth_moulton.
#include <boost/numeric/odeint/stepper/adams_bashforth_moulton.hpp>
#include <vector>

#include "integrators/odeint/fixed.hpp"

namespace polhode::inline integrators {
namespace {

template <class S>
using AdamsBashforthMoulton = boost::numeric::odeint::adams_bashforth_moulton<4, std::vector<S>, S>;

}  // namespace

IntegratorEntry odeint_adams_bashforth_moulton() {
  return odeint_fixed<AdamsBashforthMoulton>(
      {.name = "odeint_adams_bashforth_moulton",
       .family = "Boost.Odeint",
       .summary = "Adams-Bashforth-Moulton of four steps, PECE, started by Runge-Kutta 4",
       .equation =
           R"(p &= y_n + \tfrac1{24} h\,(55 f_n - 59 f_{n-1} + 37 f_{n-2} - 9 f_{n-3}), \quad f_k = f(t_k, y_k) \\
y_{n+1} &= y_n + \tfrac1{24} h\,\bigl(9 f(t_n + h, p) + 19 f_n - 5 f_{n-1} + f_{n-2}\bigr))",
       .sources = {"hairerNorsettWanner1993", "ahnertMulansky2011"},
       .order = 4,
       .multi_step = true});
}

}  // namespace polhode::integrators
