// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/simulate_ensemble.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "core/run/run_samples.hpp"

namespace polhode::inline core::inline run {
namespace {

constexpr auto lanes_of_all = std::size_t(lane_count);

/// Largest number of steps in one batch: its samples stay in the first cache.
constexpr std::int64_t longest = 32;

using Clock = std::chrono::steady_clock;

/// The loop of one ensemble.
class EnsembleLoop {
 public:
  EnsembleLoop(const EnsembleParts& parts, EnsembleObserver& observer, const std::atomic<bool>* stop)
      : parts_(parts), observer_(observer), stop_(stop), samples_(std::size_t(longest)) {}

  void run() {
    while (fill()) {
      bool ended = false;
      while (!ended) {
        if (interrupted()) return;
        ended = take_batch();
      }
    }
  }

 private:
  /// The run in one lane.
  struct Lane {
    LaneRun run;
    StepPlan plan;
    std::int64_t steps = 0;  ///< number of steps of the whole run
    std::int64_t done = 0;
    RunOutcome outcome;
    State<double> state;  ///< full state for the observer
    double seconds = 0;

    std::int64_t left() const { return steps - done; }
  };

  /// Begins runs in vacant lanes while there are some. False: no lane has a run.
  bool fill() {
    bool changed = false;
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      while (!running_[i] && more_) {
        std::optional<LaneRun> next = parts_.next(i);
        more_ = next.has_value();
        if (more_) changed = begin(i, std::move(*next)) || changed;
      }
    }
    if (changed) compose();
    shared_until_ = Clock::now();  // the time before a run is no part of its time
    return std::any_of(running_.begin(), running_.end(), [](bool is) { return is; });
  }

  /// Begins a run in a lane. False if it ends at its start.
  bool begin(std::size_t i, LaneRun&& run) {
    Lane& lane = lanes_[i];
    lane = {};
    lane.run = std::move(run);
    lane.plan = plan_steps(lane.run.schedule.t_end, lane.run.schedule.dt);
    lane.steps = lane.plan.whole + (lane.plan.last > 0 ? 1 : 0);
    lane.state = lane.run.truth->start();
    running_[i] = true;
    const State<double>& state = lane.state;
    const Sample start{0, lane.run.truth->measure(state.y), state.y[state.y.size() - 1], 0, 0};
    Observer& observer = observer_.of_lane(i);
    observer.on_start(state, start);
    if (const TakenSamples taken = hand_over({&start, 1}, observer); taken.why) {
      diverge(i, taken.why, 0);
      return false;
    }
    observer_.on_begin(i);
    return true;
  }

  /// Makes the system and the method for the runs that are now in the lanes.
  void compose() {
    std::size_t some = 0;  // a lane with a run, whose problem fills lanes without a run; their results are unused
    while (!running_[some]) ++some;
    const auto user_of = [&](std::size_t i) -> const Lane& { return lanes_[running_[i] ? i : some]; };
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < lanes_of_all; ++i) problems.push_back(user_of(i).run.truth->problem());
    method_.reset();
    system_ = make_ensemble(problems, lanes_[some].run.truth->formulation());
    method_ = parts_.method(*system_);
    watched_ = parts_.watched ? parts_.watched(problems) : std::vector<LaneQuantity>();
    values_.resize(watched_.size() * samples_.size());
    motions_.resize(watched_.empty() ? 0 : samples_.size());
    steps_of_method_ = 0;
    const bool first = state_.y.size() == 0;
    if (first) state_ = system_->start();
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      const Lane& lane = user_of(i);
      if (first || !running_[i] || lane.done == 0) put_state(i, lane.state);
      if (lane.done == 0) projection_.set(int(i), 0);
    }
    method_->begin(state_);
  }

  void put_state(std::size_t i, const State<double>& state) {
    for (Eigen::Index n = 0; n < state_.y.size(); ++n) state_.y[n].set(int(i), state.y[n]);
  }

  /// Takes steps of all lanes, shows them, and ends runs. True if a run has ended.
  bool take_batch() {
    const LaneBatch batch = next_batch();
    advance(batch);
    steps_of_method_ += batch.count;
    const std::span<LaneSample> samples(samples_.data(), std::size_t(batch.count));
    if (batch.project && system_->projection_changes_energy()) {
      for (LaneSample& s : samples) s.projection = projection_ += s.projection;
    }
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      if (!running_[i]) continue;
      lanes_[i].done += batch.count;
      if (lanes_[i].left() == 0) samples.back().t.set(int(i), lanes_[i].run.schedule.t_end);
    }
    const std::array<std::size_t, lanes_of_all> finite = finite_of(samples);
    std::array<std::size_t, lanes_of_all> accepted = finite;
    std::vector<std::span<const Lanes>>& watched = watched_values_;
    watched.clear();
    for (std::size_t which = 0; which < watched_.size(); ++which)
      watched.push_back(std::span(values_).subspan(which * samples_.size(), samples.size()));
    observer_.on_samples({samples, watched}, running_, accepted);
    const std::array<bool, lanes_of_all> due = due_after_all(samples, accepted);
    bool ended = false;
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      if (running_[i]) ended = show(i, samples, finite[i], accepted[i], due[i]) || ended;
    }
    return ended;
  }

  /// The next steps: as many as end before the last step of a run and before the state of a run is due.
  LaneBatch next_batch() {
    LaneBatch batch;
    batch.count = longest;
    batch.samples = samples_.data();
    if (!watched_.empty()) batch.motions = motions_.data();
    Lanes h = 0, t0 = 0, first = 0;  // a lane without a run stays where it is
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      if (!running_[i]) continue;
      const Lane& lane = lanes_[i];
      const double dt = lane.run.schedule.dt, done = static_cast<double>(lane.done);
      batch.project = lane.run.schedule.normalize;
      if (lane.left() == 1) {  // the last step ends exactly at t_end and may be shorter
        batch.count = 1;
      } else {
        const std::int64_t due = step_of_next_state(observer_.of_lane(i), 0, dt, lane.done);
        batch.count = std::min({batch.count, lane.left() - 1, due - lane.done});
      }
      const bool is_shorter = lane.left() == 1 && lane.plan.last > 0;
      h.set(int(i), is_shorter ? lane.plan.last : dt);
      t0.set(int(i), is_shorter ? done * dt : 0);
      first.set(int(i), is_shorter ? 0 : done);
    }
    batch.h = h;
    batch.t0 = t0;
    batch.first = first;
    return batch;
  }

  /// Takes the steps of a batch and measures the watched quantities after each.
  void advance(const LaneBatch& batch) {
    method_->advance(state_, batch);
    for (std::size_t which = 0; which < watched_.size(); ++which) {
      Lanes* values = &values_[which * samples_.size()];
      for (std::size_t k = 0; k < std::size_t(batch.count); ++k)
        values[k] = watched_[which](motions_[k], batch.samples[k].seen.angular_momentum);
    }
  }

  /// The number of samples before the first one that is not finite, for each lane with a run.
  std::array<std::size_t, lanes_of_all> finite_of(std::span<const LaneSample> samples) const {
    Lanes::Mask all(true);
    for (const LaneSample& s : samples) all = all & is_finite(s);
    std::array<std::size_t, lanes_of_all> finite{};
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      if (!running_[i]) continue;
      finite[i] = samples.size();
      if (all.bits[i]) continue;
      finite[i] = 0;
      while (is_finite(samples[finite[i]]).bits[i]) ++finite[i];
    }
    return finite;
  }

  /// Shows the states at the last sample to the observer of all. The lanes whose observers are due to receive theirs.
  std::array<bool, lanes_of_all> due_after_all(std::span<const LaneSample> samples,
                                               const std::array<std::size_t, lanes_of_all>& accepted) {
    std::array<bool, lanes_of_all> due{};
    bool some = false;
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      due[i] =
          running_[i] && accepted[i] == samples.size() && samples.back().t[int(i)] >= observer_.of_lane(i).next_state();
      some = some || due[i];
    }
    if (some) observer_.on_states({*system_, state_.y, samples.back()}, due);
    return due;
  }

  /// Shows the state of a lane at the last sample, if it is due. True if its run has ended.
  bool show(std::size_t i, std::span<const LaneSample> samples, std::size_t finite, std::size_t accepted, bool due) {
    Lane& lane = lanes_[i];
    if (accepted < samples.size()) {
      lane.done -= static_cast<std::int64_t>(samples.size() - accepted) - 1;
      diverge(i, reason_of_end(accepted < finite), samples[accepted].t[int(i)]);
      return true;
    }
    const double t = samples.back().t[int(i)];
    if (due) {
      lane.state.t = t;
      for (Eigen::Index n = 0; n < state_.y.size(); ++n) lane.state.y[n] = state_.y[n][int(i)];
      observer_.of_lane(i).on_state(lane.state, sample_in(samples.back(), int(i)));
    }
    if (lane.left() > 0) return false;
    end(i, t);
    return true;
  }

  void diverge(std::size_t i, const char* why, double t) {
    lanes_[i].outcome.status = RunStatus::diverged;
    lanes_[i].outcome.message = at_time(why, t);
    end(i, t);
  }

  void end(std::size_t i, double t) {
    share_time();
    Lane& lane = lanes_[i];
    lane.outcome.t = t;
    lane.outcome.steps = lane.done;
    lane.outcome.evaluations = steps_of_method_ > 0 ? method_->evaluations() / steps_of_method_ * lane.done : 0;
    running_[i] = false;
    observer_.on_end(i, std::move(lane.outcome), lane.seconds);
    shared_until_ = Clock::now();
  }

  /// Divides the time since the last call among the runs under way.
  void share_time() {
    const Clock::time_point now = Clock::now();
    const auto count = static_cast<double>(std::count(running_.begin(), running_.end(), true));
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      if (running_[i]) lanes_[i].seconds += std::chrono::duration<double>(now - shared_until_).count() / count;
    }
    shared_until_ = now;
  }

  bool interrupted() {
    if (!stop_ || !stop_->load(std::memory_order_relaxed)) return false;
    for (std::size_t i = 0; i < lanes_of_all; ++i) {
      if (!running_[i]) continue;
      const double t = static_cast<double>(lanes_[i].done) * lanes_[i].run.schedule.dt;
      lanes_[i].outcome.status = RunStatus::interrupted;
      lanes_[i].outcome.message = at_time("interrupted", t);
      end(i, t);
    }
    return true;
  }

  const EnsembleParts& parts_;
  EnsembleObserver& observer_;
  const std::atomic<bool>* stop_;
  std::array<Lane, lanes_of_all> lanes_;
  std::array<bool, lanes_of_all> running_{};
  bool more_ = true;  ///< there may be further runs
  std::unique_ptr<System<Lanes>> system_;
  std::unique_ptr<Integrator<Lanes>> method_;
  std::vector<LaneQuantity> watched_;
  State<Lanes> state_;
  Lanes projection_ = 0;  ///< energy injected by all projections of the run in each lane, J
  std::vector<LaneSample> samples_;
  std::vector<BodyMotion<Lanes>> motions_;  ///< of the body in each lane at each sample; empty: nothing is watched
  std::vector<Lanes> values_;               ///< values of the watched quantities: by quantity and step
  std::vector<std::span<const Lanes>> watched_values_;
  std::int64_t steps_of_method_ = 0;  ///< number of steps that method_ has taken
  Clock::time_point shared_until_ = Clock::now();
};

}  // namespace

Sample sample_in(const LaneSample& all, int lane) {
  Sample one;
  one.t = all.t[lane];
  one.seen.kinetic = all.seen.kinetic[lane];
  one.seen.potential = all.seen.potential[lane];
  for (int k = 0; k < 3; ++k) one.seen.linear_momentum[k] = all.seen.linear_momentum[k][lane];
  for (int k = 0; k < 3; ++k) one.seen.angular_momentum[k] = all.seen.angular_momentum[k][lane];
  one.seen.orientation_defect = all.seen.orientation_defect[lane];
  one.work = all.work[lane];
  one.projection = all.projection[lane];
  return one;
}

void simulate_ensemble(const EnsembleParts& parts, EnsembleObserver& observer, const std::atomic<bool>* stop) {
  EnsembleLoop(parts, observer, stop).run();
}

}  // namespace polhode::core::run
