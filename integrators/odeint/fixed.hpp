// SPDX-License-Identifier: BSD-3-Clause
// Odeint's steppers of a fixed step, behind the port of integrators, in any scalar.
//
// Stepper<S> is a stepper of Odeint over std::vector<S>: do_step(rate, x, t, h). One with reset() has a history, which
// is forgotten when the step changes.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "integrators/catalogue.hpp"

namespace polhode {

template <template <class> class Stepper, class S>
class OdeintFixed final : public Integrator<S> {
 public:
  explicit OdeintFixed(const System<S>& system) : system_(system) {}

  void begin(const State<S>& state) override {
    evaluations_ = 0;
    h_ = 0;
    stepper_ = Stepper<S>();
    x_.resize(static_cast<std::size_t>(state.y.size()));
  }

  StepResult step(State<S>& state, double h) override {
    return advance(state, Stretch{.h = h, .count = 1, .t0 = state.t});
  }

  using Integrator<S>::advance;
  StepResult advance(State<S>& state, const Stretch& stretch) override {
    if constexpr (has_history) {
      if (stretch.h != h_) stepper_.reset();
    }
    h_ = stretch.h;
    const auto rate = [this](const std::vector<S>& y, std::vector<S>& dy, S t) {
      ++evaluations_;
      system_.rate(t, y.data(), dy.data());
    };
    std::copy(state.y.data(), state.y.data() + state.y.size(), x_.begin());
    for (std::int64_t k = 0; k < stretch.count; ++k) stepper_.do_step(rate, x_, S(stretch.time(k)), S(stretch.h));
    std::copy(x_.begin(), x_.end(), state.y.data());
    state.t = stretch.time(stretch.count);
    return {};
  }

  std::int64_t evaluations() const override { return evaluations_; }

  void discard_history(const State<S>&) override {
    if constexpr (has_history) stepper_.reset();
  }

 private:
  static constexpr bool has_history = requires(Stepper<S>& s) { s.reset(); };

  const System<S>& system_;
  Stepper<S> stepper_;
  std::vector<S> x_;
  double h_ = 0;
  std::int64_t evaluations_ = 0;
};

/// The one line that registers a stepper.
template <template <class> class Stepper>
IntegratorEntry odeint_fixed(Declaration declaration) {
  const auto maker = []<class S>(const System<S>& system) { return std::make_unique<OdeintFixed<Stepper, S>>(system); };
  return {std::move(declaration),
          [maker](const System<double>& s, const IntegratorSettings&) { return maker(s); },
          [maker](const System<float>& s, const IntegratorSettings&) { return maker(s); },
          [maker](const System<long double>& s, const IntegratorSettings&) { return maker(s); }};
}

}  // namespace polhode
