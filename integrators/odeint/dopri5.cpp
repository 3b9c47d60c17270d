// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's Dormand–Prince 5(4) with error control and dense output of order 4.
// Source: Dormand & Prince, J. Comp. Appl. Math. 6 (1980); Boost.Odeint's dense_output_runge_kutta.
#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "integrators/catalogue.hpp"

namespace polhode {
namespace {

namespace odeint = boost::numeric::odeint;

class OdeintDopri5 final : public Integrator<double> {
 public:
  OdeintDopri5(const System<double>& system, const IntegratorSettings& settings)
      : system_(system), tolerance_(settings.tolerance), t_end_(settings.t_end) {}

  void begin(const State<double>& state) override {
    evaluations_ = 0;
    x_.assign(state.y.data(), state.y.data() + state.y.size());
    next_ = x_;
    h_ = first_step(state);
    restart();
  }

  StepResult step(State<double>& state, double h) override {
    const auto rhs = [this](const Vector& y, Vector& dy, double t) {
      ++evaluations_;
      system_.rate(t, y.data(), dy.data());
    };
    if (!fresh_) {
      rhs(x_, rate_, state.t);
      fresh_ = true;
    }
    const double wanted = h_;
    double trial = std::min(wanted, h);
    for (;;) {
      double t = state.t;
      double next_step = trial;
      const bool last = trial == h;
      const auto result = controlled_->try_step(rhs, x_, rate_, t, next_, next_rate_, next_step);
      if (result == odeint::success) {
        // A step that was cut short at the end of the interval says nothing about the one that comes after it.
        h_ = trial < wanted ? std::max(wanted, next_step) : next_step;
        t_before_ = state.t;
        x_before_.swap(x_);
        rate_before_.swap(rate_);
        x_.swap(next_);
        rate_.swap(next_rate_);
        state.t = last ? state.t + h : t;
        t_now_ = state.t;
        state.y = Eigen::Map<const VectorX<double>>(x_.data(), state.y.size());
        return {};
      }
      if (!(next_step < trial) || state.t + next_step == state.t) return {"Odeint's step size fell to nothing"};
      trial = next_step;
    }
  }

  std::int64_t evaluations() const override { return evaluations_; }

  void discard_history(const State<double>& state) override {
    x_.assign(state.y.data(), state.y.data() + state.y.size());
    restart();
  }

  bool has_dense_output() const override { return true; }
  bool interpolate(double t, State<double>& state) const override {
    if (!(t_before_ <= t && t <= t_now_)) return false;
    Vector y(x_.size());
    controlled_->stepper().calc_state(t, y, x_before_, rate_before_, t_before_, x_, rate_, t_now_);
    state.t = t;
    state.y = Eigen::Map<const VectorX<double>>(y.data(), state.y.size());
    return true;
  }

 private:
  using Vector = std::vector<double>;
  using Stepper = odeint::runge_kutta_dopri5<Vector>;
  using Controlled = odeint::controlled_runge_kutta<Stepper>;

  void restart() {
    controlled_.emplace(odeint::default_error_checker<double, Stepper::algebra_type, Stepper::operations_type>(
        tolerance_, tolerance_));
    rate_.resize(x_.size());
    next_rate_.resize(x_.size());
    x_before_ = x_;
    rate_before_.resize(x_.size());
    fresh_ = false;
  }

  /// A first step that the error control corrects at once: tol^(1/5) of the time in which the state changes by itself.
  double first_step(const State<double>& state) {
    Vector dy(x_.size());
    system_.rate(state.t, x_.data(), dy.data());
    ++evaluations_;
    double scale = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) scale = std::max(scale, std::abs(dy[i]) / (std::abs(x_[i]) + 1));
    const double t = scale > 0 ? 1 / scale : t_end_;
    return std::min(t_end_, 0.1 * t * std::pow(tolerance_, 0.2));
  }

  const System<double>& system_;
  double tolerance_, t_end_;
  std::optional<Controlled> controlled_;
  double h_ = 0;
  bool fresh_ = false;  ///< rate_ holds f at the present state (first same as last)
  double t_before_ = 0, t_now_ = 0;
  Vector x_, next_, rate_, next_rate_, x_before_, rate_before_;
  std::int64_t evaluations_ = 0;
};

}  // namespace

IntegratorEntry odeint_dopri5() {
  return {{.name = "odeint_dopri5",
           .family = "Boost.Odeint",
           .summary = "Dormand-Prince 5(4), error control per step, dense output",
           .order = 5,
           .adaptive = true},
          [](const System<double>& system, const IntegratorSettings& settings) {
            return std::make_unique<OdeintDopri5>(system, settings);
          }};
}

}  // namespace polhode
