// SPDX-License-Identifier: BSD-3-Clause
// Adapter of Odeint's fixed-step steppers to the port of integrators, in every scalar.
//
// Stepper<S> is an Odeint stepper over std::vector<S> with do_step(rate, x, t, h), where x is a range of numbers. A
// stepper with reset() has a history, which is discarded when the step size changes.
#pragma once

#include <utility>

#include "integrators/catalogue.hpp"

namespace polhode::inline integrators {

/// View of the numbers of a state as a range. Copying to a vector and back would cost a third of an RK4 step.
template <class S>
struct OdeintRange {
  using iterator = S*;
  using const_iterator = S*;  // a constant range of mutable numbers
  S* first;
  std::ptrdiff_t count;

  S* begin() const { return first; }
  S* end() const { return first + count; }
  S* data() const { return first; }
};

/// The integrator of a fixed-step stepper in the scalar S.
template <template <class> class Stepper, class S>
class OdeintFixed final : public Integrator<S> {
 public:
  explicit OdeintFixed(const Ode<S>& ode) : ode_(ode) {}

  void begin(const State<S>&) override {
    evaluations_ = 0;
    h_ = 0;
    stepper_ = Stepper<S>();
  }

  StepResult step(State<S>& state, double h) override {
    return advance(state, StepBatch{.h = h, .count = 1, .t0 = state.t});
  }

  using Integrator<S>::advance;
  StepResult advance(State<S>& state, const StepBatch& batch) override {
    if constexpr (has_history) {
      if (batch.h != h_) stepper_.reset();
    }
    h_ = batch.h;
    const auto rate = [this](const auto& y, auto& dy, S t) {
      ++evaluations_;
      ode_.rate(t, y.data(), dy.data());
    };
    OdeintRange<S> x{state.y.data(), state.y.size()};
    for (std::int64_t k = 0; k < batch.count; ++k) stepper_.do_step(rate, x, S(batch.time(k)), S(batch.h));
    state.t = batch.time(batch.count);
    return {};
  }

  std::int64_t evaluations() const override { return evaluations_; }

  void discard_history(const State<S>&) override {
    if constexpr (has_history) stepper_.reset();
  }

 private:
  static constexpr bool has_history = requires(Stepper<S> & s) { s.reset(); };

  const Ode<S>& ode_;
  Stepper<S> stepper_;
  double h_ = 0;
  std::int64_t evaluations_ = 0;
};

/// Catalogue entry of a fixed-step stepper. All Odeint steppers are additive: the state changes only by y + h Σ b k.
template <template <class> class Stepper>
IntegratorEntry odeint_fixed(Declaration declaration) {
  declaration.additive = true;
  const auto maker = []<class S>(const Ode<S>& ode, const IntegratorSettings&) -> IntegratorPointer<S> {
    return std::make_unique<OdeintFixed<Stepper, S>>(ode);
  };
  return {.declaration = std::move(declaration),
          .make = maker,
          .make_float = maker,
          .make_long_double = maker,
          .increments = {maker, maker, maker}};
}

}  // namespace polhode::integrators
