// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/simulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "core/run/run_samples.hpp"
#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"

namespace polhode::inline core::inline run {
namespace {

// Relative tolerance within which t_end/dt counts as a whole number. Without it the round-off of 10/0.1 would add a
// step of 1e-15 s.
constexpr double whole_tolerance = 1e-9;
// Stall detection of adaptive methods: a run fails after more than `patience` consecutive steps that are each shorter
// than least_progress × t_end.
constexpr double least_progress = 1e-14;
constexpr int patience = 1000;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", x);
  return text;
}

// True if all entries are finite. Comparing |y_i| with the largest number is false for NaN and infinity. The loop has
// no early exit, so that it vectorizes.
template <class S>
bool is_finite(const VectorX<S>& y) {
  constexpr S largest = std::numeric_limits<S>::max();
  bool finite = true;
  for (Eigen::Index i = 0; i < y.size(); ++i) finite &= std::abs(y[i]) <= largest;
  return finite;
}

// The state in double for observers: the run's own state, or a converted copy.
template <class S>
struct View {
  State<double> copy;
  const State<double>& of(const State<S>& state) {
    copy.t = state.t;
    copy.y = state.y.template cast<double>();
    return copy;
  }
};
template <>
struct View<double> {
  const State<double>& of(const State<double>& state) { return state; }
};

/// The loop of one run in the scalar S.
template <class S>
class Loop {
 public:
  Loop(const System<S>& system, const System<double>& truth, Integrator<S>& integrator, State<S>& state,
       const Schedule& schedule, Observer& observer, const std::atomic<bool>* stop, ContactModel* contact)
      : system_(system),
        truth_(truth),
        integrator_(integrator),
        state_(state),
        schedule_(schedule),
        observer_(observer),
        stop_(stop),
        contact_(contact),
        t0_(state.t),
        observed_(state.t),
        projects_joints_(system.has_joints() && system.formulation().joints.projects()),
        account_(projects_joints_ || (schedule.normalize && system.projection_changes_energy())) {}

  RunOutcome run() {
    if constexpr (std::is_same_v<S, double>) {
      if (contact_) contact_->begin(integrator_, state_);
    } else if (contact_) {
      throw std::invalid_argument("contact works in double only");
    }
    {
      const JointSolves counted(*this);
      integrator_.begin(state_);
    }
    const Sample start = measure(state_);
    tell_multipliers(integrator_.multipliers());
    observer_.on_start(view_.of(state_), start);
    if (take_samples({&start, 1}) && !interrupted()) {
      if (schedule_.adaptive) adaptive();
      else if (schedule_.next_step) given();
      else fixed();
    }
    outcome_.t = state_.t;
    // The last batch may contain steps after the one at which the observer ended the run.
    const std::int64_t taken = outcome_.steps + surplus_steps_;
    outcome_.evaluations =
        surplus_steps_ > 0 ? integrator_.evaluations() / taken * outcome_.steps : integrator_.evaluations();
    outcome_.iterations = integrator_.iterations();
    return outcome_;
  }

 private:
  /// Counts the linear systems of the joints that are solved while it lives; those of observers are not.
  class JointSolves {
   public:
    explicit JointSolves(Loop& loop) : loop_(loop), before_(loop.joint_systems()) {}
    ~JointSolves() { loop_.outcome_.joint_solves += loop_.joint_systems() - before_; }
    JointSolves(const JointSolves&) = delete;
    JointSolves& operator=(const JointSolves&) = delete;

   private:
    Loop& loop_;
    const std::int64_t before_;
  };
  std::int64_t joint_systems() const { return system_.has_joints() ? system_.constraints()->solved() : 0; }

  Sample measure(const State<S>& state) {
    const State<double>& seen = view_.of(state);
    return {.t = seen.t,
            .seen = truth_.measure(seen.y),
            .work = seen.y[system_.layout().work()],
            .projection = projection_energy_,
            .joint_work = system_.has_joints() ? seen.y[system_.layout().joint_work()] : 0.0};
  }

  /// Passes samples to the observer. False ends the run as diverged.
  bool take_samples(std::span<const Sample> samples) {
    const TakenSamples taken = hand_over(samples, observer_);
    if (!taken.why) return true;
    state_.t = samples[taken.count].t;
    diverged(taken.why);
    surplus_steps_ = static_cast<std::int64_t>(samples.size() - taken.count) - 1;
    outcome_.steps -= surplus_steps_;
    return false;
  }

  void diverged(const char* why) {
    outcome_.status = RunStatus::diverged;
    outcome_.message = at_time(why, state_.t);
  }

  bool interrupted() {
    if (!stop_ || !stop_->load(std::memory_order_relaxed)) return false;
    outcome_.status = RunStatus::interrupted;
    outcome_.message = at_time("interrupted", state_.t);
    return true;
  }

  StepResult step(double h) {
    if constexpr (std::is_same_v<S, double>) {
      if (contact_) return contact_->step(integrator_, state_, h);
    }
    return integrator_.step(state_, h);
  }

  /// Calls the method for some steps. Returns false if it fails or throws; the outcome then holds the reason.
  template <class Steps>
  bool done(const Steps& steps) {
    const JointSolves counted(*this);
    std::string why;
    try {
      why = steps().failure;
    } catch (const std::bad_alloc&) {
      throw;  // lack of memory is not a failure of the method
    } catch (const std::exception& error) {
      why = error.what();
      if (!is_finite(state_.y)) {
        diverged("the state ceased to be finite");
        return false;
      }
    }
    if (why.empty()) return true;
    fail(std::move(why));
    return false;
  }

  void fail(std::string why) {
    outcome_.status = RunStatus::failed;
    outcome_.message = at_time(std::move(why), state_.t);
  }

  /// Takes one step, checks that the state is finite, and projects. False ends the run.
  bool take_step(double h, std::optional<double> t_after) {
    const double before_step = state_.t;
    if (!done([&] { return step(h); })) return false;
    const bool ended = contact_ && contact_->ended();
    if (!contact_ && state_.t >= observer_.next_within_step()) look_within_step(before_step);
    if (t_after && !ended) state_.t = *t_after;  // t_k = t0 + k h, without accumulated round-off
    if (contact_ && !contact_->impacts().empty()) observer_.on_impacts(contact_->impacts());
    if (contact_ && !contact_->transitions().empty()) observer_.on_slides_end(contact_->transitions());
    ++outcome_.steps;
    const bool progress =
        t_after || state_.t - before_step > least_progress * schedule_.t_end || state_.t >= schedule_.t_end;
    steps_without_progress_ = progress ? 0 : steps_without_progress_ + 1;
    if (steps_without_progress_ > patience) {
      fail("the step size fell to nothing");
      return false;
    }
    if (!is_finite(state_.y)) {
      diverged("the state ceased to be finite");
      return false;
    }
    if (const NativeProjection* native = integrator_.native_projection()) {
      projection_energy_ = native->projection_energy();
    } else if (schedule_.normalize || projects_joints_) {
      const JointSolves counted(*this);
      const double before = account_ ? energy() : 0.0;
      if (schedule_.normalize) system_.project(state_.y);
      if (projects_joints_) project_joints(system_, state_.y);
      if (account_) projection_energy_ += energy() - before;
      integrator_.discard_history(state_);
    }
    if (ended) {
      if (state_.t > observed_) observe_now();
      return false;
    }
    return !interrupted();
  }

  double energy() { return truth_.measure(view_.of(state_).y).energy(); }

  void look_within_step(double start) {
    const DenseOutput<S>* dense = integrator_.dense_output();
    if (!dense) return;
    State<S> between = state_;
    for (const double part : {0.25, 0.5, 0.75}) {
      if (dense->interpolate(start + part * (state_.t - start), between))
        observer_.on_state_within_step(view_.of(between));
    }
  }

  void tell_multipliers(std::span<const S> multipliers) {
    if (multipliers.empty()) return;
    multipliers_.assign(multipliers.begin(), multipliers.end());
    observer_.on_multipliers(multipliers_);
  }

  bool observe_now() { return observe(state_, integrator_.multipliers()); }
  bool observe(const State<S>& state, std::span<const S> multipliers) {
    const Sample sample = measure(state);
    observed_ = sample.t;
    if (contact_) observer_.on_contact_energy(contact_->losses());
    if (!take_samples({&sample, 1})) return false;
    if (sample.t < observer_.next_state()) return true;
    tell_multipliers(multipliers);
    observer_.on_state(view_.of(state), sample);
    return !interrupted();
  }

  double sample_time(std::int64_t k) const {
    if (k == *schedule_.samples) return schedule_.t_end;
    return t0_ + static_cast<double>(k) * (schedule_.t_end - t0_) / static_cast<double>(*schedule_.samples);
  }

  void fixed() {
    const StepPlan plan = plan_steps(schedule_.t_end - t0_, schedule_.dt);
    const std::int64_t steps = plan.whole + (plan.last > 0 ? 1 : 0);
    const std::int64_t stride = schedule_.samples ? steps / *schedule_.samples : 1;
    std::int64_t k = 0;
    // All steps before the last are taken in batches if the method supports them and every step is sampled.
    if (integrator_.takes_batches() && stride == 1 && !contact_ && !projects_joints_) {
      const std::int64_t until = plan.last > 0 ? plan.whole : plan.whole - 1;
      while (k < until) {
        const std::int64_t n =
            std::min(longest_batch, std::min(until, step_of_next_state(observer_, t0_, schedule_.dt, k)) - k);
        if (!take_batch(k, n)) return;
        k += n;
      }
    }
    while (k < steps) {
      ++k;
      const double h = k <= plan.whole ? schedule_.dt : plan.last;
      const bool sampled = k % stride == 0;
      double t_after = t0_ + static_cast<double>(k) * schedule_.dt;
      if (sampled && schedule_.samples) t_after = sample_time(k / stride);
      if (k == steps) t_after = schedule_.t_end;
      if (!take_step(h, t_after)) return;
      if (sampled && !observe_now()) return;
    }
  }

  bool take_batch(std::int64_t k, std::int64_t n) {
    const StepBatch batch{schedule_.dt, n, t0_, k, schedule_.normalize, samples_.data()};
    if (!done([&] { return integrator_.advance(state_, batch); })) return false;
    outcome_.steps += n;
    const std::span<Sample> samples(samples_.data(), static_cast<std::size_t>(n));
    for (Sample& s : samples) s.projection = projection_energy_ += s.projection;
    if (!take_samples(samples)) return false;
    if (samples.back().t >= observer_.next_state()) observer_.on_state(view_.of(state_), samples.back());
    return !interrupted();
  }

  /// Takes steps of the sizes from next_step; the time is their accumulated sum.
  void given() {
    if (schedule_.samples)
      throw std::invalid_argument("steps that are given one by one are all observed; ask for no samples");
    while (state_.t < schedule_.t_end) {
      double h = schedule_.next_step();
      if (h == 0) return;
      if (!(h > 0) || !std::isfinite(h))
        throw std::invalid_argument("a step must be a positive number of seconds, or 0 to end");
      const double left = schedule_.t_end - state_.t;
      const bool last = h >= left * (1 - whole_tolerance);
      if (h > left * (1 + whole_tolerance)) h = left;
      if (!take_step(h, last ? schedule_.t_end : state_.t + h) || !observe_now()) return;
    }
  }

  void adaptive() {
    State<S> between = state_;
    std::int64_t next = 1;
    // Steps must end exactly at the sample times under projection or contact, or if the method has no dense output.
    const DenseOutput<S>* dense = integrator_.dense_output();
    const bool shorten = schedule_.samples && (schedule_.normalize || projects_joints_ || contact_ || !dense);
    while (state_.t < schedule_.t_end) {
      const double target = shorten ? sample_time(next) : schedule_.t_end;
      if (outcome_.steps >= schedule_.most_steps) return fail(too_many_steps());
      if (!take_step(target - state_.t, std::nullopt)) return;
      if (!schedule_.samples) {
        if (!observe_now()) return;
        continue;
      }
      for (; next <= *schedule_.samples && sample_time(next) <= state_.t; ++next) {
        if (sample_time(next) == state_.t) {
          if (!observe_now()) return;
        } else if (dense && dense->interpolate(sample_time(next), between)) {
          if (!observe(between, dense->interpolated_multipliers())) return;
        } else {
          outcome_.status = RunStatus::failed;
          outcome_.message = at_time("no dense output", sample_time(next));
          return;
        }
      }
    }
  }

  std::string too_many_steps() const {
    std::string why = "not at the end after ";
    why += std::to_string(schedule_.most_steps);
    return why += " steps; take a larger --tolerance, a shorter --t-end or more --max-steps; it stood";
  }

  const System<S>& system_;
  const System<double>& truth_;
  Integrator<S>& integrator_;
  State<S>& state_;
  const Schedule& schedule_;
  Observer& observer_;
  const std::atomic<bool>* stop_;
  ContactModel* contact_;
  const double t0_;             ///< start time of the run, s
  double observed_;             ///< time of the last sample outside a batch, s
  const bool projects_joints_;  ///< project onto the equations of the joints after each step
  const bool account_;          ///< projections can change the energy, which is measured before and after them
  View<S> view_;
  std::vector<double> multipliers_;
  double projection_energy_ = 0;
  std::int64_t surplus_steps_ = 0;
  int steps_without_progress_ = 0;
  std::array<Sample, longest_batch> samples_;
  RunOutcome outcome_;
};

}  // namespace

StepPlan plan_steps(double t_end, double dt) {
  if (!(dt > 0) || !std::isfinite(dt)) throw std::invalid_argument("dt must be a positive number of seconds");
  if (!(t_end > 0) || !std::isfinite(t_end)) throw std::invalid_argument("t_end must be a positive number of seconds");
  const double ratio = t_end / dt;
  if (ratio > 9e15) throw std::invalid_argument("dt is too small for t_end: more than 9e15 steps");
  StepPlan plan;
  const double nearest = std::round(ratio);
  if (nearest >= 1 && std::abs(ratio - nearest) <= whole_tolerance * std::max(1.0, nearest * 1e-3)) {
    plan.whole = static_cast<std::int64_t>(nearest);
    return plan;
  }
  plan.whole = static_cast<std::int64_t>(std::floor(ratio));
  plan.last = t_end - static_cast<double>(plan.whole) * dt;
  return plan;
}

std::string sampling_problem(const Schedule& schedule) {
  if (schedule.adaptive || !schedule.samples) return {};
  const StepPlan plan = plan_steps(schedule.t_end, schedule.dt);
  const std::int64_t n = *schedule.samples;
  if (plan.last == 0 && plan.whole % n == 0) return {};
  const double spacing = schedule.t_end / static_cast<double>(n);
  const double fitting = spacing / std::max(1.0, std::round(spacing / schedule.dt));
  return std::to_string(n) + " samples of " + number(schedule.t_end) + " s do not fall on whole steps of " +
         number(schedule.dt) + " s; dt = " + number(fitting) + " would fit, or leave --samples out to see every step";
}

template <class S>
RunOutcome simulate(const System<S>& system, const System<double>& truth, Integrator<S>& integrator, State<S>& state,
                    const Schedule& schedule, Observer& observer, const std::atomic<bool>* stop,
                    ContactModel* contact) {
  return Loop<S>(system, truth, integrator, state, schedule, observer, stop, contact).run();
}

template RunOutcome simulate(const System<float>&, const System<double>&, Integrator<float>&, State<float>&,
                             const Schedule&, Observer&, const std::atomic<bool>*, ContactModel*);
template RunOutcome simulate(const System<double>&, const System<double>&, Integrator<double>&, State<double>&,
                             const Schedule&, Observer&, const std::atomic<bool>*, ContactModel*);
template RunOutcome simulate(const System<long double>&, const System<double>&, Integrator<long double>&,
                             State<long double>&, const Schedule&, Observer&, const std::atomic<bool>*, ContactModel*);

}  // namespace polhode::core::run
