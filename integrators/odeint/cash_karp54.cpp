// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's Cash–Karp 5(4) with error control.
// Source: Cash & Karp, ACM TOMS 16 (1990); Boost.Odeint's runge_kutta_cash_karp54.
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <vector>

#include "integrators/odeint/controlled.hpp"

namespace polhode::inline integrators {
namespace {

namespace odeint = boost::numeric::odeint;

template <class S>
class CashKarp54 {
 public:
  using Vector = std::vector<S>;
  using Stepper = odeint::runge_kutta_cash_karp54<Vector, S>;
  static constexpr int order = 5;
  static constexpr bool first_same_as_last = false;

  CashKarp54(double tolerance, std::size_t)
      : stepper_(odeint::default_error_checker<S, typename Stepper::algebra_type, typename Stepper::operations_type>(
            S(tolerance), S(tolerance))) {}

  template <class Rate>
  bool try_step(const Rate& rate, const Vector& x, const Vector& dx, S& t, Vector& next, Vector&, S& h) {
    return stepper_.try_step(rate, x, dx, t, next, h) == odeint::success;
  }

 private:
  odeint::controlled_runge_kutta<Stepper> stepper_;
};

}  // namespace

IntegratorEntry odeint_cash_karp54() {
  return odeint_controlled<CashKarp54>(
      {.name = "odeint_cash_karp54",
       .family = "Boost.Odeint",
       .summary = "Cash-Karp 5(4), error control per step",
       .equation =
           R"(k_i &= f\bigl(t_n + c_i h,\; y_n + h \textstyle\sum_{j<i} a_{ij} k_j\bigr), \quad i = 1, \dots, 6 \\
y_{n+1} &= y_n + h\,\bigl(\tfrac{37}{378} k_1 + \tfrac{250}{621} k_3 + \tfrac{125}{594} k_4
  + \tfrac{512}{1771} k_6\bigr) \\
e &= h \textstyle\sum_i (b_i - \tilde b_i)\,k_i, \quad \tilde b = \bigl(\tfrac{2825}{27648}, 0,
  \tfrac{18575}{48384}, \tfrac{13525}{55296}, \tfrac{277}{14336}, \tfrac14\bigr) \\
\text{accepted if}\quad & \max_i \frac{|e_i|}{\mathrm{tol}\,\bigl(1 + |y_{n,i}| + h\,|f_i(t_n, y_n)|\bigr)} \le 1)",
       .sources = {"cashKarp1990", "ahnertMulansky2011"},
       .order = 5});
}

}  // namespace polhode::integrators
