// SPDX-License-Identifier: BSD-3-Clause
// How a fixed-step method written as a template says that its step is a sum, y' = y + Δ(t, h, y): then it can take the
// ODE of the increment too (integrators/shifted_system.hpp), and integrators/compensated.hpp can add the increments up
// without their rounding. The method must ask its system for no more than that one has.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "integrators/catalogue.hpp"
#include "integrators/shifted_system.hpp"

namespace polhode {

/// The method on the ODE of the increment, step by step.
template <template <class> class Method, class S>
class IncrementStep final : public Integrator<S> {
 public:
  IncrementStep(const ShiftedSystem<S>& system, int evaluations_per_step)
      : system_(system), method_(system), evaluations_per_step_(evaluations_per_step) {}

  void begin(const State<S>&) override {
    steps_ = 0;
    method_ = Method<ShiftedSystem<S>>(system_);
  }

  StepResult step(State<S>& state, double h) override {
    if constexpr (std::is_void_v<decltype(method_.step(system_, S(), S(), state.y))>) {
      method_.step(system_, S(state.t), S(h), state.y);
    } else {
      VectorX<S> z = state.y;
      if (const char* failure = method_.step(system_, S(state.t), S(h), z)) return {failure};
      state.y = z;
    }
    state.t += h;
    ++steps_;
    return {};
  }

  std::int64_t evaluations() const override {
    if constexpr (requires { method_.evaluations(); }) return method_.evaluations();
    else return steps_ * evaluations_per_step_;
  }

 private:
  const ShiftedSystem<S>& system_;
  Method<ShiftedSystem<S>> method_;
  int evaluations_per_step_;
  std::int64_t steps_ = 0;
};

/// additive<Rk4>(fixed_step<Rk4>({.name = "rk4", …})): the entry's makers take a ShiftedSystem too.
template <template <class> class Method>
IntegratorEntry additive(IntegratorEntry entry) {
  entry.declaration.additive = true;
  const auto extend = [n = entry.declaration.evaluations_per_step]<class S>(IntegratorMaker<S>& make) {
    make = [n, plain = std::move(make)](const System<S>& system, const IntegratorSettings& settings) -> IntegratorPointer<S> {
      if (const auto* shifted = dynamic_cast<const ShiftedSystem<S>*>(&system)) {
        return std::make_unique<IncrementStep<Method, S>>(*shifted, n);
      }
      return plain(system, settings);
    };
  };
  extend(entry.make);
  extend(entry.make_float);
  extend(entry.make_long_double);
  return entry;
}

}  // namespace polhode
