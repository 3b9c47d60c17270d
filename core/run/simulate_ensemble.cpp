// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/simulate_ensemble.hpp"

#include <algorithm>
#include <array>

#include "core/run/run_samples.hpp"

namespace polhode {
namespace {

/// The loop of one ensemble.
class EnsembleLoop {
 public:
  EnsembleLoop(const System<Lanes>& system, Integrator<Lanes>& integrator, std::span<const LaneRun> runs,
               const Schedule& schedule, const std::atomic<bool>* stop, std::span<const LaneQuantity> watched)
      : system_(system),
        integrator_(integrator),
        runs_(runs),
        schedule_(schedule),
        stop_(stop),
        watched_(watched),
        state_(system.start()),
        lanes_(runs.size()),
        samples_(std::size_t(longest_batch) * std::size_t(lane_count)),
        values_(watched.size() * samples_.size()) {}

  std::vector<RunOutcome> run() {
    integrator_.begin(state_);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      Lane& lane = lanes_[i];
      lane.state = runs_[i].truth.start();
      const Sample start{0, runs_[i].truth.measure(lane.state.y), lane.state.y[lane.state.y.size() - 1], 0};
      runs_[i].observer.on_start(lane.state, start);
      take(i, {&start, 1}, 0);
    }
    all_steps();
    std::vector<RunOutcome> outcomes;
    for (Lane& lane : lanes_) {
      if (lane.running) lane.outcome.t = state_.t;
      lane.outcome.evaluations = taken_ > 0 ? integrator_.evaluations() / taken_ * lane.outcome.steps : 0;
      outcomes.push_back(lane.outcome);
    }
    return outcomes;
  }

 private:
  /// The run in one lane.
  struct Lane {
    RunOutcome outcome;
    State<double> state;  ///< full state for Observer::on_state()
    double projection_energy = 0;
    bool running = true;
  };

  bool any_running() const {
    return std::any_of(lanes_.begin(), lanes_.end(), [](const Lane& lane) { return lane.running; });
  }

  void all_steps() {
    const StepPlan plan = plan_steps(schedule_.t_end, schedule_.dt);
    const std::int64_t steps = plan.whole + (plan.last > 0 ? 1 : 0);
    std::int64_t k = 0;
    while (k < steps && any_running() && !interrupted()) {
      // The last step ends exactly at t_end and may be shorter.
      StepBatch batch{schedule_.dt, 1, 0, k, schedule_.normalize};
      if (k < steps - 1) {
        batch.count = std::min(longest_batch, steps - 1 - k);
        for (std::size_t i = 0; i < runs_.size(); ++i) {
          if (!lanes_[i].running) continue;
          batch.count = std::min(batch.count, step_of_next_state(runs_[i].observer, 0, schedule_.dt, k) - k);
        }
      } else if (plan.last > 0) {
        batch = {plan.last, 1, static_cast<double>(k) * schedule_.dt, 0, schedule_.normalize};
      }
      batch.samples = samples_.data();
      batch.lanes = static_cast<int>(runs_.size());
      batch.lane_stride = longest_batch;
      advance(batch);
      taken_ += batch.count;
      k += batch.count;
      if (k == steps) state_.t = schedule_.t_end;
      for (std::size_t i = 0; i < runs_.size(); ++i) {
        if (lanes_[i].running) show(i, batch.count, k == steps);
      }
    }
  }

  /// Takes the steps of a batch; where quantities are watched, one by one.
  void advance(const StepBatch& batch) {
    if (watched_.empty()) {
      integrator_.advance(state_, batch);
      return;
    }
    StepBatch step = batch;
    step.count = 1;
    for (std::int64_t k = 0; k < batch.count; ++k) {
      step.first = batch.first + k;
      step.samples = batch.samples + k;
      integrator_.advance(state_, step);
      const BodySnapshot<Lanes> body = system_.snapshot(state_.y, 0);
      for (std::size_t which = 0; which < watched_.size(); ++which) {
        const Lanes values = watched_[which](body);
        for (std::size_t i = 0; i < runs_.size(); ++i)
          values_of(which, i)[std::size_t(k)] = values[static_cast<int>(i)];
      }
    }
  }

  /// The values of a watched quantity in lane i after the steps of the last batch.
  std::span<double> values_of(std::size_t which, std::size_t i) {
    return std::span(values_).subspan((which * runs_.size() + i) * std::size_t(longest_batch),
                                      std::size_t(longest_batch));
  }

  /// Passes the samples of lane i in the last batch of steps to its observer.
  void show(std::size_t i, std::int64_t count, bool last) {
    Lane& lane = lanes_[i];
    const std::span<Sample> samples(samples_.data() + i * std::size_t(longest_batch), static_cast<std::size_t>(count));
    for (Sample& s : samples) s.projection = lane.projection_energy += s.projection;
    if (last) samples.back().t = schedule_.t_end;
    if (!take(i, samples, count)) return;
    if (samples.back().t < runs_[i].observer.next_state()) return;
    lane.state.t = samples.back().t;
    for (Eigen::Index n = 0; n < state_.y.size(); ++n) lane.state.y[n] = state_.y[n][static_cast<int>(i)];
    runs_[i].observer.on_state(lane.state, samples.back());
  }

  /// Passes samples of lane i to its observer and adds `steps` to the count of its steps. False ends the run of the
  /// lane as diverged.
  bool take(std::size_t i, std::span<const Sample> samples, std::int64_t steps) {
    Lane& lane = lanes_[i];
    const TakenSamples taken = hand_over(samples, runs_[i].observer);
    lane.outcome.steps += steps;
    if (steps > 0 && runs_[i].on_watched) {
      for (std::size_t which = 0; which < watched_.size(); ++which)
        runs_[i].on_watched(which, values_of(which, i).first(taken.count));
    }
    if (!taken.why) return true;
    const double t = samples[taken.count].t;
    lane.outcome.steps -= std::int64_t(samples.size() - taken.count) - 1;
    lane.outcome.t = t;
    lane.outcome.status = RunStatus::diverged;
    lane.outcome.message = at_time(taken.why, t);
    lane.running = false;
    return false;
  }

  bool interrupted() {
    if (!stop_ || !stop_->load(std::memory_order_relaxed)) return false;
    for (Lane& lane : lanes_) {
      if (!lane.running) continue;
      lane.outcome.status = RunStatus::interrupted;
      lane.outcome.message = at_time("interrupted", state_.t);
    }
    return true;
  }

  const System<Lanes>& system_;
  Integrator<Lanes>& integrator_;
  std::span<const LaneRun> runs_;
  const Schedule& schedule_;
  const std::atomic<bool>* stop_;
  std::span<const LaneQuantity> watched_;
  State<Lanes> state_;
  std::vector<Lane> lanes_;
  std::vector<Sample> samples_;
  std::vector<double> values_;  ///< of the watched quantities: by quantity, lane and step
  std::int64_t taken_ = 0;
};

}  // namespace

std::vector<RunOutcome> simulate_ensemble(const System<Lanes>& system, Integrator<Lanes>& integrator,
                                          std::span<const LaneRun> runs, const Schedule& schedule,
                                          const std::atomic<bool>* stop, std::span<const LaneQuantity> watched) {
  return EnsembleLoop(system, integrator, runs, schedule, stop, watched).run();
}

}  // namespace polhode
