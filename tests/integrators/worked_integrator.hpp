// SPDX-License-Identifier: BSD-3-Clause
// Ralston's method: y' = y + h/4 (k1 + 3 k2), k1 = f(t, y), k2 = f(t + 2h/3, y + 2h/3 k1).
// Source: Ralston, Math. Comp. 16 (1962).
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class Ralston {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;  // (q, v, work), contiguous

  explicit Ralston(const System& system) : k1_(system.zero()), k2_(system.zero()), inner_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    system.rate(t, y, k1_);
    const S part = S(2) * h / S(3);
    inner_ = y + part * k1_;
    system.rate(t + part, inner_, k2_);
    y += (h / S(4)) * (k1_ + S(3) * k2_);
  }

 private:
  Flat k1_, k2_, inner_;
};

IntegratorEntry ralston() {
  return fixed_step<Ralston>(
      {.name = "ralston",
       .family = "textbook",
       .summary = "y' = y + h/4 (k1 + 3 k2), k2 = f(t + 2h/3, y + 2h/3 k1)",
       .equation = R"(k_1 &= f(t_n, y_n), \quad k_2 = f(t_n + \tfrac23 h, y_n + \tfrac23 h\,k_1) \\
y_{n+1} &= y_n + \tfrac14 h\,(k_1 + 3 k_2))",
       .sources = {"ralston1962"},
       .order = 2,
       .evaluations_per_step = 2});
}

}  // namespace polhode::integrators
