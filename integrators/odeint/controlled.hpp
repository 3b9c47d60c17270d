// SPDX-License-Identifier: BSD-3-Clause
// Common part of Odeint's controlled steppers: first step, shortened steps, rejected trials, dense output.
//
// Requirements on a method:
//   Method(double tolerance, size)  constructor.
//   try_step(rate, x, dx, t, next, next_dx, h)
//                        takes a trial step of h (s) from x, with dx = f(t, x). Returns true if the error estimate
//                        accepts the step, and sets h to the next proposal.
//   first_same_as_last   true if try_step() fills next_dx.
//   calc_state(t, y, x0, dx0, t0, x1, dx1, t1)  optional: dense output.
//   order                determines the first step.
//
// Odeint accepts a step whose error estimate is NaN: `error > 1` is false, and the maximum norm ignores NaN. Here a
// step is accepted only if all its numbers are finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "integrators/catalogue.hpp"

namespace polhode::inline integrators {

/// The integrator of a controlled stepper in the scalar S.
template <class Method, class S>
class OdeintControlled final : public Integrator<S>, public DenseOutput<S> {
 public:
  using Vector = std::vector<S>;

  OdeintControlled(const System<S>& system, const IntegratorSettings& settings)
      : system_(system), tolerance_(settings.tolerance), t_end_(settings.t_end) {}

  void begin(const State<S>& state) override {
    evaluations_ = 0;
    take_over(state);
    rate(x_, rate_, S(state.t));
    fresh_ = true;
    h_ = first_step();
  }

  StepResult step(State<S>& state, double h) override {
    const auto rhs = [this](const Vector& y, Vector& dy, S t) { rate(y, dy, t); };
    if (!fresh_) rate(x_, rate_, S(state.t));
    fresh_ = true;
    const double wanted = h_;
    double trial = std::min(wanted, h);
    bool cut_short = trial < wanted;
    for (;;) {
      S t = S(state.t), proposal = S(trial);
      const double taken = trial == h ? h : double(proposal);  // time is in double for every scalar
      bool passed = method_->try_step(rhs, x_, rate_, t, next_, next_rate_, proposal);
      if (passed && !is_finite(next_)) {
        passed = false;
        proposal = S(retreat * trial);
      }
      if (passed) {
        // A step that was shortened to end at h must not reduce the size of the next step.
        h_ = cut_short ? std::max(wanted, double(proposal)) : double(proposal);
        accept(state, state.t + taken);
        return {};
      }
      // If the right-hand side is NaN, the proposal may be NaN or a longer step.
      if (!(double(proposal) < trial)) proposal = S(retreat * trial);
      trial = double(proposal);
      if (state.t + trial == state.t) return {"Odeint's step size fell to nothing"};
      cut_short = false;
    }
  }

  std::int64_t evaluations() const override { return evaluations_; }

  void discard_history(const State<S>& state) override {
    take_over(state);
    fresh_ = false;
  }

  const DenseOutput<S>* dense_output() const override { return dense ? this : nullptr; }
  bool interpolate(double t, State<S>& state) const override {
    if constexpr (dense) {
      if (!(t_before_ <= t && t <= t_now_)) return false;
      Vector y(x_.size());
      method_->calc_state(S(t), y, x_before_, rate_before_, S(t_before_), x_, rate_, S(t_now_));
      state.t = t;
      std::copy(y.begin(), y.end(), state.y.data());
      return true;
    } else {
      return false;
    }
  }

 private:
  static constexpr bool dense = requires(const Method& m, Vector& v, S t) { m.calc_state(t, v, v, v, t, v, v, t); };
  static constexpr double retreat = 0.2;

  static bool is_finite(const Vector& x) {
    return std::all_of(x.begin(), x.end(), [](S number) { return std::isfinite(number); });
  }

  void rate(const Vector& y, Vector& dy, S t) {
    ++evaluations_;
    system_.rate(t, y.data(), dy.data());
  }

  void take_over(const State<S>& state) {
    x_.resize(static_cast<std::size_t>(state.y.size()));
    std::copy(state.y.data(), state.y.data() + state.y.size(), x_.begin());
    next_ = rate_ = next_rate_ = x_before_ = rate_before_ = x_;
    t_before_ = t_now_ = state.t;
    method_.emplace(tolerance_, x_.size());
  }

  void accept(State<S>& state, double t) {
    t_before_ = state.t;
    x_before_.swap(x_);
    rate_before_.swap(rate_);
    x_.swap(next_);
    rate_.swap(next_rate_);
    fresh_ = Method::first_same_as_last;
    state.t = t_now_ = t;
    std::copy(x_.begin(), x_.end(), state.y.data());
  }

  /// Size of the first trial step (s): 0.1 tolerance^(1/p) × the time in which the state changes by its own magnitude.
  /// The error control corrects it immediately.
  double first_step() const {
    double scale = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      scale = std::max(scale, double(std::abs(rate_[i]) / (std::abs(x_[i]) + 1)));
    }
    const double t = scale > 0 ? 1 / scale : t_end_;
    return std::min(t_end_, 0.1 * t * std::pow(tolerance_, 1.0 / Method::order));
  }

  const System<S>& system_;
  double tolerance_, t_end_;
  std::optional<Method> method_;
  double h_ = 0;
  bool fresh_ = false;  ///< true: rate_ is f at the present state
  double t_before_ = 0, t_now_ = 0;
  Vector x_, next_, rate_, next_rate_, x_before_, rate_before_;
  std::int64_t evaluations_ = 0;
};

/// Catalogue entry of a controlled method Method<S> in float, double and long double.
template <template <class> class Method>
IntegratorEntry odeint_controlled(Declaration declaration) {
  declaration.adaptive = true;
  const auto maker = []<class S>(const System<S>& system, const IntegratorSettings& settings) {
    return std::make_unique<OdeintControlled<Method<S>, S>>(system, settings);
  };
  return {std::move(declaration), [maker](const System<double>& s, const IntegratorSettings& x) { return maker(s, x); },
          [maker](const System<float>& s, const IntegratorSettings& x) { return maker(s, x); },
          [maker](const System<long double>& s, const IntegratorSettings& x) { return maker(s, x); }};
}

/// Catalogue entry of a controlled method in double only.
template <class Method>
IntegratorEntry odeint_controlled_in_double(Declaration declaration) {
  declaration.adaptive = true;
  return {std::move(declaration), [](const System<double>& system, const IntegratorSettings& settings) {
            return std::make_unique<OdeintControlled<Method, double>>(system, settings);
          }};
}

}  // namespace polhode::integrators
