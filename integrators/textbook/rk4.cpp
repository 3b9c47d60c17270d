// SPDX-License-Identifier: BSD-3-Clause
// The classical Runge–Kutta method: y' = y + h/6 (k1 + 2 k2 + 2 k3 + k4).
// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.1 (Kutta 1901).
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class Rk4 {
 public:
  static_assert(FlatOde<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit Rk4(const System& system)
      : k1_(system.zero()), k2_(system.zero()), k3_(system.zero()), k4_(system.zero()), stage_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2);
    system.rate(t, y, k1_);
    stage_ = y + half * k1_;
    system.rate(t + half, stage_, k2_);
    stage_ = y + half * k2_;
    system.rate(t + half, stage_, k3_);
    stage_ = y + h * k3_;
    system.rate(t + h, stage_, k4_);
    y += (h / S(6)) * (k1_ + S(2) * (k2_ + k3_) + k4_);
  }

 private:
  Flat k1_, k2_, k3_, k4_, stage_;
};

IntegratorEntry rk4() {
  return additive_step<Rk4, Forms::lanes>(
      {.name = "rk4",
       .family = "textbook",
       .summary = "the classical Runge-Kutta method, y' = y + h/6 (k1 + 2 k2 + 2 k3 + k4)",
       .equation = R"(k_1 &= f(t_n, y_n), \quad k_2 = f\bigl(t_n + \tfrac12 h,\; y_n + \tfrac12 h\,k_1\bigr) \\
k_3 &= f\bigl(t_n + \tfrac12 h,\; y_n + \tfrac12 h\,k_2\bigr), \quad k_4 = f(t_n + h,\; y_n + h\,k_3) \\
y_{n+1} &= y_n + \tfrac16 h\,(k_1 + 2 k_2 + 2 k_3 + k_4))",
       .sources = {"kutta1901", "hairerNorsettWanner1993"},
       .order = 4,
       .evaluations_per_step = 4});
}

}  // namespace polhode::integrators
