// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's Fehlberg 7(8) with error control.
// Source: Fehlberg, NASA TR R-287 (1968); Boost.Odeint's runge_kutta_fehlberg78.
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <vector>

#include "integrators/odeint/controlled.hpp"

namespace polhode::inline integrators {
namespace {

namespace odeint = boost::numeric::odeint;

template <class S>
class Fehlberg78 {
 public:
  using Vector = std::vector<S>;
  using Stepper = odeint::runge_kutta_fehlberg78<Vector, S>;
  static constexpr int order = 8;
  static constexpr bool first_same_as_last = false;

  Fehlberg78(double tolerance, std::size_t)
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

IntegratorEntry odeint_fehlberg78() {
  return odeint_controlled<Fehlberg78>(
      {.name = "odeint_fehlberg78",
       .family = "Boost.Odeint",
       .summary = "Fehlberg 7(8), the eighth order carried on, error control per step",
       .equation =
           R"(k_i &= f\bigl(t_n + c_i h,\; y_n + h \textstyle\sum_{j<i} a_{ij} k_j\bigr), \quad i = 1, \dots, 13 \\
y_{n+1} &= y_n + h\,\bigl(\tfrac{34}{105} k_6 + \tfrac9{35} (k_7 + k_8) \\
&\qquad + \tfrac9{280} (k_9 + k_{10}) + \tfrac{41}{840} (k_{12} + k_{13})\bigr) \\
e &= \tfrac{41}{840} h\,(k_{12} + k_{13} - k_1 - k_{11}) \\
\text{accepted if}\quad & \max_i \frac{|e_i|}{\mathrm{tol}\,\bigl(1 + |y_{n,i}| + h\,|f_i(t_n, y_n)|\bigr)} \le 1)",
       .sources = {"fehlberg1968", "ahnertMulansky2011"},
       .order = 8});
}

}  // namespace polhode::integrators
