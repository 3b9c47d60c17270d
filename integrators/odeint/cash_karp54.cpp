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
  return odeint_controlled<CashKarp54>({.name = "odeint_cash_karp54",
                                        .family = "Boost.Odeint",
                                        .summary = "Cash-Karp 5(4), error control per step",
                                        .order = 5});
}

}  // namespace polhode::integrators
