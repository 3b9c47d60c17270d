// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's Rosenbrock method of order 4(3), L-stable, with error control and dense output. It evaluates the
// Jacobian and ∂f/∂t, here by central difference quotients, once per trial step. The state is copied to a vector of
// Boost.uBLAS. Source: Hairer & Wanner, Solving Ordinary Differential Equations II, IV.7 and VI.4 (RODAS);
// Boost.Odeint's rosenbrock4 and rosenbrock4_controller.
#include "integrators/odeint/controlled.hpp"
#include "integrators/odeint/rosenbrock4_stepper.hpp"

namespace polhode::inline integrators {
namespace {

class Rosenbrock4 {
 public:
  using Vector = std::vector<double>;
  static constexpr int order = 4;
  static constexpr bool first_same_as_last = false;

  Rosenbrock4(double tolerance, std::size_t size) : stepper_(tolerance, size) {}

  template <class Rate>
  bool try_step(const Rate& rate, const Vector& x, const Vector&, double& t, Vector& next, Vector&, double& h) {
    return stepper_.try_step(rate, x, t, next, h);
  }

  void calc_state(double t, Vector& y, const Vector& x0, const Vector&, double t0, const Vector& x1, const Vector&,
                  double t1) const {
    stepper_.calc_state(t, y, x0, t0, x1, t1);
  }

 private:
  Rosenbrock4Stepper stepper_;
};

}  // namespace

IntegratorEntry odeint_rosenbrock4() {
  return odeint_controlled_in_double<Rosenbrock4>(
      {.name = "odeint_rosenbrock4",
       .family = "Boost.Odeint",
       .summary = "Rosenbrock 4(3), L-stable, Jacobian by difference quotients, error control per step, dense output",
       .equation =
           R"(\bigl(\tfrac1{\gamma h} - J\bigr) u_i &= f\bigl(t_n + c_i h,\; y_n + \textstyle\sum_{j<i} a_{ij} u_j\bigr)
  + \tfrac1h \sum_{j<i} c_{ij} u_j + d_i h\,\partial_t f \\
y_{n+1} &= y_n + \textstyle\sum_{j<5} a_{5j} u_j + u_5 + u_6, \quad e = u_6, \quad \gamma = \tfrac14, \quad i = 1, \dots, 6 \\
J &= \partial_y f(t_n, y_n), \quad \text{accepted if }
  \Bigl(\tfrac1N \textstyle\sum_i (e_i/w_i)^2\Bigr)^{1/2} \le 1 \\
w_i &= \mathrm{tol}\,\bigl(1 + \max(|y_{n,i}|, |y_{n+1,i}|)\bigr))",
       .sources = {"hairerWanner1996", "ahnertMulansky2011"},
       .order = 4,
       .implicit = true});
}

}  // namespace polhode::integrators
