// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's Bulirsch–Stoer method: Gragg's modified midpoint rule, extrapolated in h² to an order selected by the
// error control. Dense output is not offered: bulirsch_stoer_dense_out interpolates about the middle of a step, matches
// the ends of the step only to the tolerance, and takes different steps.
// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.9; Boost.Odeint's bulirsch_stoer.
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <vector>

#include "integrators/odeint/controlled.hpp"

namespace polhode::inline integrators {
namespace {

namespace odeint = boost::numeric::odeint;

template <class S>
class BulirschStoer {
 public:
  using Vector = std::vector<S>;
  static constexpr int order = 8;  // order for the first step, which starts with four columns
  static constexpr bool first_same_as_last = false;

  BulirschStoer(double tolerance, std::size_t) : stepper_(S(tolerance), S(tolerance)) {}

  template <class Rate>
  bool try_step(const Rate& rate, const Vector& x, const Vector& dx, S& t, Vector& next, Vector&, S& h) {
    return stepper_.try_step(rate, x, dx, t, next, h) == odeint::success;
  }

 private:
  odeint::bulirsch_stoer<Vector, S> stepper_;
};

}  // namespace

IntegratorEntry odeint_bulirsch_stoer() {
  return odeint_controlled<BulirschStoer>({
      .name = "odeint_bulirsch_stoer",
      .family = "Boost.Odeint",
      .summary = "Bulirsch-Stoer, the midpoint rule extrapolated to a variable order, error control per step",
      .equation = R"(z_0 &= y_n, \quad z_1 = z_0 + \eta f(t_n, z_0), \quad \eta = h/n_j, \quad n_j = 2, 4, 6, \dots \\
z_{m+1} &= z_{m-1} + 2 \eta f(t_n + m \eta, z_m), \quad m = 1, \dots, n_j - 1 \\
T_{j,0} &= \tfrac12 \bigl(z_{n_j - 1} + z_{n_j} + \eta f(t_n + h, z_{n_j})\bigr) \\
T_{j,k} &= T_{j,k-1} + \frac{T_{j,k-1} - T_{j-1,k-1}}{(n_j/n_{j-k})^2 - 1}, \quad y_{n+1} = T_{k,k})",
      .sources = {"hairerNorsettWanner1993", "ahnertMulansky2011"},
  });
}

}  // namespace polhode::integrators
