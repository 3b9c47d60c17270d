// SPDX-License-Identifier: BSD-3-Clause
// Heun's method, the explicit trapezoidal rule: y' = y + h/2 (f(t, y) + f(t + h, y + h f(t, y))).
// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.1 (Heun 1900).
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class Heun {
 public:
  static_assert(FlatOde<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit Heun(const System& system) : k1_(system.zero()), k2_(system.zero()), stage_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    system.rate(t, y, k1_);
    stage_ = y + h * k1_;
    system.rate(t + h, stage_, k2_);
    y += (h / S(2)) * (k1_ + k2_);
  }

 private:
  Flat k1_, k2_, stage_;
};

IntegratorEntry heun() {
  return additive_step<Heun, Forms::lanes>({.name = "heun",
                                            .family = "textbook",
                                            .summary = "y' = y + h/2 (f(t, y) + f(t + h, y + h f(t, y)))",
                                            .equation = R"(k_1 &= f(t_n, y_n), \quad k_2 = f(t_n + h,\; y_n + h\,k_1) \\
y_{n+1} &= y_n + \tfrac12 h\,(k_1 + k_2))",
                                            .sources = {"heun1900", "hairerNorsettWanner1993"},
                                            .order = 2,
                                            .evaluations_per_step = 2});
}

}  // namespace polhode::integrators
