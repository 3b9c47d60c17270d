// SPDX-License-Identifier: BSD-3-Clause
// Explicit Euler: q' = q + h N(q) v, v' = v + h v̇(t, q, v). All rates are those of the old state.
// Source: the engine slides, "Integration": p_next = p + p'Δt, θ_next = θ + (Δt/2) ω θ, θ'_next = θ' + θ''Δt.
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class ExplicitEuler {
 public:
  static_assert(FlatOde<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  static constexpr bool remembers_nothing = true;

  explicit ExplicitEuler(const System& system) : rate_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    system.rate(t, y, rate_);
    y += h * rate_;
  }

 private:
  Flat rate_;
};

IntegratorEntry explicit_euler() {
  return additive_step<ExplicitEuler, Forms::lanes>(
      {.name = "explicit_euler",
       .family = "textbook",
       .summary = "y' = y + h f(t, y), all from the old state, as the slides write it",
       .equation = R"(y_{n+1} &= y_n + h\,f(t_n, y_n))",
       .sources = {"engineSlides", "hairerNorsettWanner1993"},
       .order = 1,
       .evaluations_per_step = 1});
}

}  // namespace polhode::integrators
