// SPDX-License-Identifier: BSD-3-Clause
// Explicit midpoint rule: y' = y + h f(t + h/2, y + (h/2) f(t, y)).
// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.1 (Runge 1895).
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class ExplicitMidpoint {
 public:
  static_assert(FlatOde<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit ExplicitMidpoint(const System& system) : rate_(system.zero()), middle_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2);
    system.rate(t, y, rate_);
    middle_ = y + half * rate_;
    system.rate(t + half, middle_, rate_);
    y += h * rate_;
  }

 private:
  Flat rate_, middle_;
};

IntegratorEntry explicit_midpoint() {
  return additive_step<ExplicitMidpoint, Forms::lanes>({.name = "explicit_midpoint",
                                                        .family = "textbook",
                                                        .summary = "y' = y + h f(t + h/2, y + h/2 f(t, y))",
                                                        .equation = R"(k_1 &= f(t_n, y_n) \\
y_{n+1} &= y_n + h\,f\bigl(t_n + \tfrac12 h,\; y_n + \tfrac12 h\,k_1\bigr))",
                                                        .sources = {"runge1895", "hairerNorsettWanner1993"},
                                                        .order = 2,
                                                        .evaluations_per_step = 2});
}

}  // namespace polhode::integrators
