// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's Dormand–Prince 5(4) with error control and dense output of order 4.
// Source: Dormand & Prince, J. Comp. Appl. Math. 6 (1980); Boost.Odeint's dense_output_runge_kutta.
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <vector>

#include "integrators/odeint/controlled.hpp"

namespace polhode::inline integrators {
namespace {

namespace odeint = boost::numeric::odeint;

template <class S>
class Dopri5 {
 public:
  using Vector = std::vector<S>;
  using Stepper = odeint::runge_kutta_dopri5<Vector, S>;
  static constexpr int order = 5;
  static constexpr bool first_same_as_last = true;

  Dopri5(double tolerance, std::size_t)
      : stepper_(odeint::default_error_checker<S, typename Stepper::algebra_type, typename Stepper::operations_type>(
            S(tolerance), S(tolerance))) {}

  template <class Rate>
  bool try_step(const Rate& rate, const Vector& x, const Vector& dx, S& t, Vector& next, Vector& next_dx, S& h) {
    return stepper_.try_step(rate, x, dx, t, next, next_dx, h) == odeint::success;
  }

  void calc_state(S t, Vector& y, const Vector& x0, const Vector& dx0, S t0, const Vector& x1, const Vector& dx1,
                  S t1) const {
    stepper_.stepper().calc_state(t, y, x0, dx0, t0, x1, dx1, t1);
  }

 private:
  odeint::controlled_runge_kutta<Stepper> stepper_;
};

}  // namespace

IntegratorEntry odeint_dopri5() {
  return odeint_controlled<Dopri5>(
      {.name = "odeint_dopri5",
       .family = "Boost.Odeint",
       .summary = "Dormand-Prince 5(4), error control per step, dense output",
       .equation =
           R"(k_i &= f\bigl(t_n + c_i h,\; y_n + h \textstyle\sum_{j<i} a_{ij} k_j\bigr), \quad i = 1, \dots, 7 \\
y_{n+1} &= y_n + h\,\bigl(\tfrac{35}{384} k_1 + \tfrac{500}{1113} k_3 + \tfrac{125}{192} k_4
  - \tfrac{2187}{6784} k_5 + \tfrac{11}{84} k_6\bigr) \\
k_7 &= f(t_n + h, y_{n+1}), \quad e = h \textstyle\sum_i (b_i - \tilde b_i)\,k_i \\
\tilde b &= \bigl(\tfrac{5179}{57600}, 0, \tfrac{7571}{16695}, \tfrac{393}{640}, -\tfrac{92097}{339200},
  \tfrac{187}{2100}, \tfrac1{40}\bigr) \\
\text{accepted if}\quad & \max_i \frac{|e_i|}{\mathrm{tol}\,\bigl(1 + |y_{n,i}| + h\,|f_i(t_n, y_n)|\bigr)} \le 1)",
       .sources = {"dormandPrince1980", "ahnertMulansky2011"},
       .order = 5});
}

}  // namespace polhode::integrators
