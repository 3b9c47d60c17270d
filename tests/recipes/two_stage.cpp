// SPDX-License-Identifier: BSD-3-Clause
// A made-up method with settings of its own, one of each type: the explicit Runge–Kutta methods of two stages,
//   y' = y + h ((1 − 1/2c) k1 + k2/2c), k1 = f(t, y), k2 = f(t + c h, y + c h k1),
// taken n times with h/n in each step. With c = 1/2 it is explicit_midpoint, with c = 1 heun.
#include <cstdint>

#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

template <class System>
class TwoStage {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  static Setting node() {
    return {.key = "node", .usual = 0.5, .meaning = "c of the second stage", .lowest = 0.25, .highest = 1};
  }
  static Setting substep_count() {
    return {.key = "substep_count", .usual = 1, .meaning = "n", .lowest = 1, .highest = 8};
  }
  static Setting weighting() {
    return {.key = "weighting", .usual = "both", .meaning = "of the stages", .choices = {"both", "last"}};
  }

  TwoStage(const System& system, const IntegratorSettings& settings)
      : c_(S(settings.number(node()))),
        n_(settings.whole(substep_count())),
        last_(settings.text(weighting()) == "last"),
        k1_(system.zero()),
        k2_(system.zero()),
        inner_(system.zero()) {}

  void step(const System& system, S t, S h, Flat& y) {
    const S part = h / S(n_), share = last_ ? S(1) : S(1) / (S(2) * c_);
    for (std::int64_t i = 0; i < n_; ++i) {
      const S now = t + S(i) * part;
      system.rate(now, y, k1_);
      inner_ = y + (c_ * part) * k1_;
      system.rate(now + c_ * part, inner_, k2_);
      y += part * ((S(1) - share) * k1_ + share * k2_);
      evaluations_ += 2;
    }
  }

  std::int64_t evaluations() const { return evaluations_; }

 private:
  S c_;
  std::int64_t n_;
  bool last_;
  std::int64_t evaluations_ = 0;
  Flat k1_, k2_, inner_;
};

IntegratorEntry two_stage() {
  using Any = TwoStage<ManyBodies<double>>;
  return additive_step<TwoStage>({.name = "two_stage",
                                  .family = "made up",
                                  .summary = "Runge-Kutta of two stages, the second at h/2",
                                  .order = 2,
                                  .settings = {Any::node(), Any::substep_count(), Any::weighting()}});
}

}  // namespace polhode::integrators
