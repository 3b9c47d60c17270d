// SPDX-License-Identifier: BSD-3-Clause
// How a fixed-step method written as a template becomes an entry of the catalogue.
//
// Method<System> has a constructor Method(const System&) and step(system, t, h, y), which advances the flat state y by
// h. The step sees the concrete system, so it inlines; the state of one body stays in registers and on the stack while
// a run advances, through projection and measurement too. A step that can fail returns a const char*: null, or why; it
// may leave y as it likes. A method whose evaluations differ from step to step counts them: evaluations(). One whose
// members are scratch, with no memory of the steps before, may say `static constexpr bool remembers_nothing = true;`:
// then the stages of one body need not outlive a step, and stay in registers.
#pragma once

#include <type_traits>
#include <utility>

#include "core/math/flatten.hpp"
#include "core/system/rigid_bodies.hpp"
#include "integrators/catalogue.hpp"

namespace polhode {

template <template <class> class Method, MechanicalSystem System>
class FixedStep final : public Integrator<typename System::Scalar> {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  FixedStep(const System& system, int evaluations_per_step)
      : system_(system), method_(system), evaluations_per_step_(evaluations_per_step) {}

  void begin(const State<S>&) override {
    steps_ = 0;
    method_ = Method<System>(system_);
  }
  StepResult step(State<S>& state, double h) override {
    if constexpr (can_fail) {
      Flat y = state.y;
      if (const char* failure = method_.step(system_, S(state.t), S(h), y)) return {failure};
      state.y = y;
      state.t += h;
      ++steps_;
      return {};
    } else {
      return this->advance(state, h, 1);
    }
  }

  bool takes_stretches() const override { return measures && !can_fail; }

  using Integrator<S>::advance;

  StepResult advance(State<S>& state, const Stretch& stretch) override {
    if constexpr (can_fail) {
      return Integrator<S>::advance(state, stretch);
    } else if constexpr (measures) {
      take_inlined(state, stretch);
    } else {
      take([this]() -> Method<System>& { return method_; }, stretch, state.y);
    }
    state.t = stretch.time(stretch.count);
    steps_ += stretch.count;
    return {};
  }

  std::int64_t evaluations() const override {
    if constexpr (requires { method_.evaluations(); }) return method_.evaluations();
    else return steps_ * evaluations_per_step_;
  }

 private:
  static constexpr bool can_fail =
      std::is_same_v<const char*, decltype(std::declval<Method<System>&>().step(std::declval<const System&>(), S(), S(),
                                                                                std::declval<Flat&>()))>;

  // Flattened: without it the compiler leaves calls between the stages, which doubles the cost of a step of one body.
  // Not for float and long double, whose steps nobody waits for: it would be a third of the time to compile a method.
  POLHODE_FLATTEN void take_inlined(State<S>& state, const Stretch& stretch) {
    if constexpr (System::is_one) {
      // Local copies, which the compiler can keep in registers.
      Flat y = Eigen::Map<const Flat>(state.y.data());
      if constexpr (requires { Method<System>::remembers_nothing; }) {
        take([this] { return Method<System>(system_); }, stretch, y);
      } else {
        Method<System> method = method_;
        take([&method]() -> Method<System>& { return method; }, stretch, y);
        method_ = method;
      }
      Eigen::Map<Flat>{state.y.data()} = y;
    } else {
      take([this]() -> Method<System>& { return method_; }, stretch, state.y);
    }
  }

  template <class MethodOfStep>
  void take(const MethodOfStep& method, const Stretch& stretch, Flat& y) const {
    for (std::int64_t k = 1; k <= stretch.count; ++k) {
      method().step(system_, S(stretch.time(k - 1)), S(stretch.h), y);
      if constexpr (measures) finish_step(stretch, k, y);
    }
  }

  static constexpr bool measures = std::is_same_v<S, double> || is_lanes<S>;

  /// Projection and measurement, as the driver does them for methods that take no stretches.
  void finish_step(const Stretch& stretch, std::int64_t k, Flat& y) const {
    S injected = 0;
    if (stretch.project) {
      const bool account = stretch.samples && system_.projection_changes_energy();
      const S before = account ? energy(y) : S(0);
      system_.project_flat(y.data());
      if (account) injected = energy(y) - before;
    }
    if (!stretch.samples) return;
    const Measurement<S> m = system_.measure_flat(y.data());
    if constexpr (is_lanes<S>) {
      const S work = y[y.size() - 1];
      for (int i = 0; i < stretch.lanes; ++i) {
        Sample& to = stretch.samples[i * stretch.lane_stride + k - 1];
        to.t = stretch.time(k);
        to.seen.kinetic = m.kinetic[i];
        to.seen.potential = m.potential[i];
        for (int j = 0; j < 3; ++j) to.seen.linear_momentum[j] = m.linear_momentum[j][i];
        for (int j = 0; j < 3; ++j) to.seen.angular_momentum[j] = m.angular_momentum[j][i];
        to.seen.orientation_defect = m.orientation_defect[i];
        to.work = work[i];
        to.projection = injected[i];
      }
    } else {
      stretch.samples[k - 1] = {stretch.time(k), m, y[y.size() - 1], injected};
    }
  }

  /// Of a copy, and not inlined: rarely called, and the state above stays in registers.
  [[gnu::noinline]] S energy(Flat y) const { return system_.measure_flat(y.data()).energy(); }

  const System& system_;
  Method<System> method_;
  int evaluations_per_step_;
  std::int64_t steps_ = 0;
};

/// The one line that registers a fixed-step method: fixed_step<Rk4>({.name = "rk4", …}). A method whose step does not
/// branch on its numbers can work in the lanes of an ensemble too: fixed_step<Rk4, in_lanes>.
template <template <class> class Method, bool with_lanes = false>
IntegratorEntry fixed_step(Declaration declaration) {
  const int evaluations = declaration.evaluations_per_step;
  const auto maker = [evaluations]<class S>(const System<S>& system) -> IntegratorPointer<S> {
    return visit_system(system, [&]<class Concrete>(const Concrete& concrete) -> IntegratorPointer<S> {
      return std::make_unique<FixedStep<Method, Concrete>>(concrete, evaluations);
    });
  };
  IntegratorMaker<Lanes> lanes;
  if constexpr (with_lanes) lanes = [maker](const System<Lanes>& s, const IntegratorSettings&) { return maker(s); };
  return {.declaration = std::move(declaration),
          .make = [maker](const System<double>& s, const IntegratorSettings&) { return maker(s); },
          .make_float = [maker](const System<float>& s, const IntegratorSettings&) { return maker(s); },
          .make_long_double = [maker](const System<long double>& s, const IntegratorSettings&) { return maker(s); },
          .make_lanes = std::move(lanes)};
}

}  // namespace polhode
