// SPDX-License-Identifier: BSD-3-Clause
// Adapter that turns a fixed-step method, written as a class template, into an entry of the catalogue.
//
// Requirements on a method:
//   Method(const System&)    constructor; Method(const System&, const IntegratorSettings&) of a method with settings of
//                            its own (Declaration::settings).
//   step(system, t, h, y)    advances the flat state y from time t (s) by h (s). A step that can fail returns a
//                            const char*: null on success, otherwise the reason; y is then unspecified.
//   static_assert(…)         states the concept of core/system/concepts.hpp that the method uses, for example
//                            LieGroup<System>.
//   evaluations()            optional: number of right-hand side evaluations, if it differs from step to step.
//   iterations()             optional: number of iterations, if it solves equations by iteration.
//   static constexpr bool remembers_nothing = true;
//                            optional, if all members are scratch storage: the stages of one body then stay in
//                            registers.
//
// The step is compiled for the interface ManyBodies. Unless Forms says otherwise it is compiled for each type of a
// single free body as well, so that the operations inline: the state stays in registers and on the stack during a batch
// of steps.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "core/math/flatten.hpp"
#include "core/system/concepts.hpp"
#include "core/system/many_bodies.hpp"
#include "core/system/visit_system.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::inline integrators {

/// The integrator of a fixed-step method for a concrete system.
template <class Method, FlatOde System>
class FixedStep final : public Integrator<typename System::Scalar> {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  using typename Integrator<S>::Batch;

  FixedStep(std::shared_ptr<const System> system, const IntegratorSettings& settings, int evaluations_per_step)
      : owner_(std::move(system)),
        system_(*owner_),
        settings_(settings),
        method_(made()),
        evaluations_per_step_(evaluations_per_step) {}

  void begin(const State<S>&) override {
    steps_ = 0;
    method_ = made();
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

  bool takes_batches() const override { return measures && !can_fail; }

  using Integrator<S>::advance;

  StepResult advance(State<S>& state, const Batch& batch) override {
    if constexpr (can_fail) {
      return Integrator<S>::advance(state, batch);
    } else if constexpr (measures) {
      take_inlined(state, batch);
    } else {
      take([this]() -> Method& { return method_; }, batch, state.y);
    }
    if constexpr (!is_lanes<S>) state.t = batch.time(batch.count);  // in lanes each run has a time of its own
    steps_ += batch.count;
    return {};
  }

  std::int64_t evaluations() const override {
    if constexpr (requires { method_.evaluations(); }) return method_.evaluations();
    else return steps_ * evaluations_per_step_;
  }

  std::optional<std::int64_t> iterations() const override {
    if constexpr (requires { method_.iterations(); }) return method_.iterations();
    else return std::nullopt;
  }

 private:
  Method made() const {
    if constexpr (std::is_constructible_v<Method, const System&, const IntegratorSettings&>) {
      return Method(system_, settings_);
    } else {
      return Method(system_);
    }
  }

  static constexpr bool can_fail =
      std::is_same_v<const char*, decltype(std::declval<Method&>().step(std::declval<const System&>(), S(), S(),
                                                                        std::declval<Flat&>()))>;

  // Flattening inlines the calls between the stages, which would otherwise double the cost of a step of one body. Float
  // and long double are not flattened: that would add a third to the compile time of a method.
  POLHODE_FLATTEN void take_inlined(State<S>& state, const Batch& batch) {
    if constexpr (System::is_one) {
      // Local copies can stay in registers.
      Flat y = Eigen::Map<const Flat>(state.y.data());
      static_assert(
          !is_lanes<S> || requires { Method::remembers_nothing; }, "a lane passes from one run to the next");
      if constexpr (requires { Method::remembers_nothing; }) {
        take([this] { return Method(system_); }, batch, y);
      } else {
        Method method = method_;
        take([&method]() -> Method& { return method; }, batch, y);
        method_ = method;
      }
      Eigen::Map<Flat>{state.y.data()} = y;
    } else {
      take([this]() -> Method& { return method_; }, batch, state.y);
    }
  }

  template <class MethodOfStep>
  void take(const MethodOfStep& method, const Batch& batch, Flat& y) const {
    for (std::int64_t k = 1; k <= batch.count; ++k) {
      method().step(system_, S(batch.time(k - 1)), S(batch.h), y);
      if constexpr (measures) finish_step(batch, k, y);
    }
  }

  static constexpr bool measures = Measurable<System> && (std::is_same_v<S, double> || is_lanes<S>);
  /// True if projection and measurement inline too. A call costs a twentieth of a step of these methods, as the state
  /// goes to memory for it. The other methods are slower, and compile faster with the call.
  static constexpr bool measures_inline = System::is_one && requires { Method::remembers_nothing; };

  /// Projects and measures after step k, like the simulation loop does for methods without batches of steps.
  void finish_step(const Batch& batch, std::int64_t k, Flat& y) const {
    S injected = 0;
    if (batch.project) {
      const bool account = batch.samples && system_.projection_changes_energy();
      const S before = account ? energy(y) : S(0);
      if constexpr (measures_inline) measurement::project(system_, y.data());
      else system_.project_flat(y.data());
      if (account) injected = energy(y) - before;
    }
    if (!batch.samples) return;
    BodyMotion<S>* motion = nullptr;
    if constexpr (is_lanes<S>) motion = batch.motions ? batch.motions + (k - 1) : nullptr;
    batch.samples[k - 1] = {batch.time(k), measurement_of(y, motion), y[y.size() - 1], injected, S(0)};
    if constexpr (!System::is_one) {
      if (system_.has_joints()) batch.samples[k - 1].joint_work = y[system_.layout().joint_work()];
    }
  }

  /// `motion`: if given, which is for lanes only, receives the motion of the first body.
  Measurement<S> measurement_of(const Flat& y, BodyMotion<S>* motion) const {
    if constexpr (measures_inline) {
      return measurement::measure(system_, y.data(), motion);
    } else {
      if constexpr (is_lanes<S>) {
        if (motion) *motion = system_.motion(y.data(), 0);
      }
      return system_.measure_flat(y.data());
    }
  }

  /// Energy of a copy of the state, J. The function is rarely called and not inlined, so that the state of the caller
  /// stays in registers.
  [[gnu::noinline]] S energy(Flat y) const { return system_.measure_flat(y.data()).energy(); }

  std::shared_ptr<const System> owner_;
  const System& system_;
  IntegratorSettings settings_;
  Method method_;
  int evaluations_per_step_;
  std::int64_t steps_ = 0;
};

/// The forms of a system for which a method is compiled. ManyBodies, in three scalars, is always one.
enum class Forms {
  many_bodies,  ///< no other form: a step of a single body takes 10 to 100 ns longer, compiling less than half the time
  engine_body,  ///< also a single free body in double, with a quaternion and ω in world axes, as engines have it
  one_body,     ///< also a single free body in double, in each formulation
  lanes,        ///< also the lanes of an ensemble of such bodies. The method has no branches that depend on the state.
};

/// A pointer that does not own.
template <class System>
std::shared_ptr<const System> borrowed(const System& system) {
  return {std::shared_ptr<const System>(), &system};
}

/// Builds the catalogue entry of a fixed-step method: fixed_step<Rk4>({.name = "rk4", …}).
template <template <class> class Method, Forms forms = Forms::one_body>
IntegratorEntry fixed_step(Declaration declaration) {
  const int evaluations = declaration.evaluations_per_step;
  const auto maker = [evaluations]<class S>(const System<S>& system,
                                            const IntegratorSettings& settings) -> IntegratorPointer<S> {
    const auto made = [&]<class Form>(std::shared_ptr<const Form> form) -> IntegratorPointer<S> {
      return std::make_unique<FixedStep<Method<Form>, Form>>(std::move(form), settings, evaluations);
    };
    if constexpr (forms == Forms::engine_body && has_one_body_form<S>) {
      using Engine = RigidBodies<S, Orientation::quaternion, AngularState::velocity_world, BodyCount::one>;
      if (const auto* form = dynamic_cast<const Engine*>(&system)) return made(borrowed(*form));
    }
    if constexpr (forms <= Forms::engine_body) return made(many_bodies_form(system));
    else return visit_system(system, [&](const auto& form) { return made(borrowed(form)); });
  };
  IntegratorEntry entry{
      .declaration = std::move(declaration), .make = maker, .make_float = maker, .make_long_double = maker};
  if constexpr (forms == Forms::lanes) entry.make_lanes = maker;
  return entry;
}

/// Builds the catalogue entry of an additive method. Its step adds an increment to the flat state and uses only a
/// FlatOde or a PartitionedOde, so that compensated summation applies.
template <template <class> class Method, Forms forms = Forms::one_body>
IntegratorEntry additive_step(Declaration declaration) {
  declaration.additive = true;
  IntegratorEntry entry = fixed_step<Method, forms>(std::move(declaration));
  const auto maker = [evaluations = entry.declaration.evaluations_per_step]<class S>(
                         const ShiftedSystem<S>& change, const IntegratorSettings& settings) -> IntegratorPointer<S> {
    using Change = ShiftedSystem<S>;
    return std::make_unique<FixedStep<Method<Change>, Change>>(borrowed(change), settings, evaluations);
  };
  entry.increments = {maker, maker, maker};
  return entry;
}

}  // namespace polhode::integrators
