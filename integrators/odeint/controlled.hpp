// SPDX-License-Identifier: BSD-3-Clause
// What Odeint's controlled steppers share here: the first step, steps cut short, rejected trials, dense output.
//
// Method has a constructor Method(tolerance, size) and try_step(rate, x, dx, t, next, next_dx, h), which takes a step
// of h, is true where its error estimate lets the step pass, and leaves its next proposal in h. dx is f(t, x); a method
// that is `first_same_as_last` fills next_dx, and one that has calc_state(t, y, x0, dx0, t0, x1, dx1, t1) has dense
// output. Method::order sets the first step.
//
// Odeint takes an error estimate that is no number for a small one: `error > 1` is false of it, and its maximum norm
// drops it. A step passes here only if all its numbers are finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "integrators/catalogue.hpp"

namespace polhode {

template <class Method>
class OdeintControlled final : public Integrator<double> {
 public:
  using Vector = std::vector<double>;

  OdeintControlled(const System<double>& system, const IntegratorSettings& settings)
      : system_(system), tolerance_(settings.tolerance), t_end_(settings.t_end) {}

  void begin(const State<double>& state) override {
    evaluations_ = 0;
    take_over(state);
    rate(x_, rate_, state.t);
    fresh_ = true;
    h_ = first_step();
  }

  StepResult step(State<double>& state, double h) override {
    const auto rhs = [this](const Vector& y, Vector& dy, double t) { rate(y, dy, t); };
    if (!fresh_) rate(x_, rate_, state.t);
    fresh_ = true;
    const double wanted = h_;
    double trial = std::min(wanted, h);
    bool cut_short = trial < wanted;
    for (;;) {
      double t = state.t;
      double proposal = trial;
      const bool last = trial == h;
      bool passed = method_->try_step(rhs, x_, rate_, t, next_, next_rate_, proposal);
      if (passed && !is_finite(next_)) {
        passed = false;
        proposal = retreat * trial;
      }
      if (passed) {
        // A step that was cut short at the end of the interval says nothing about the one that comes after it.
        h_ = cut_short ? std::max(wanted, proposal) : proposal;
        accept(state, last ? state.t + h : t);
        return {};
      }
      // Where the right-hand side is no number a proposal may be none, or a longer step.
      if (!(proposal < trial)) proposal = retreat * trial;
      if (state.t + proposal == state.t) return {"Odeint's step size fell to nothing"};
      trial = proposal;
      cut_short = false;
    }
  }

  std::int64_t evaluations() const override { return evaluations_; }

  void discard_history(const State<double>& state) override {
    take_over(state);
    fresh_ = false;
  }

  bool has_dense_output() const override { return dense; }
  bool interpolate(double t, State<double>& state) const override {
    if constexpr (dense) {
      if (!(t_before_ <= t && t <= t_now_)) return false;
      Vector y(x_.size());
      method_->calc_state(t, y, x_before_, rate_before_, t_before_, x_, rate_, t_now_);
      state.t = t;
      std::copy(y.begin(), y.end(), state.y.data());
      return true;
    } else {
      return false;
    }
  }

 private:
  static constexpr bool dense = requires(const Method& m, Vector& v, double t) {
    m.calc_state(t, v, v, v, t, v, v, t);
  };
  static constexpr double retreat = 0.2;

  static bool is_finite(const Vector& x) {
    return std::all_of(x.begin(), x.end(), [](double number) { return std::isfinite(number); });
  }

  void rate(const Vector& y, Vector& dy, double t) {
    ++evaluations_;
    system_.rate(t, y.data(), dy.data());
  }

  void take_over(const State<double>& state) {
    x_.resize(static_cast<std::size_t>(state.y.size()));
    std::copy(state.y.data(), state.y.data() + state.y.size(), x_.begin());
    next_ = rate_ = next_rate_ = x_before_ = rate_before_ = x_;
    t_before_ = t_now_ = state.t;
    method_.emplace(tolerance_, x_.size());
  }

  void accept(State<double>& state, double t) {
    t_before_ = state.t;
    x_before_.swap(x_);
    rate_before_.swap(rate_);
    x_.swap(next_);
    rate_.swap(next_rate_);
    fresh_ = Method::first_same_as_last;
    state.t = t_now_ = t;
    std::copy(x_.begin(), x_.end(), state.y.data());
  }

  /// A first step that the error control corrects at once: tol^(1/p) of the time in which the state changes by itself.
  double first_step() const {
    double scale = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) scale = std::max(scale, std::abs(rate_[i]) / (std::abs(x_[i]) + 1));
    const double t = scale > 0 ? 1 / scale : t_end_;
    return std::min(t_end_, 0.1 * t * std::pow(tolerance_, 1.0 / Method::order));
  }

  const System<double>& system_;
  double tolerance_, t_end_;
  std::optional<Method> method_;
  double h_ = 0;
  bool fresh_ = false;  ///< rate_ holds f at the present state
  double t_before_ = 0, t_now_ = 0;
  Vector x_, next_, rate_, next_rate_, x_before_, rate_before_;
  std::int64_t evaluations_ = 0;
};

/// The one line that registers a controlled method.
template <class Method>
IntegratorEntry odeint_controlled(Declaration declaration) {
  declaration.adaptive = true;
  return {std::move(declaration), [](const System<double>& system, const IntegratorSettings& settings) {
            return std::make_unique<OdeintControlled<Method>>(system, settings);
          }};
}

}  // namespace polhode
