// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/run_times.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/math/lanes.hpp"
#include "experiments/study/metrics/motion_scales.hpp"
#include "experiments/study/metrics/references.hpp"
#include "experiments/study/process/alarm.hpp"
#include "experiments/study/run/run.hpp"

namespace polhode::study::inline workers {
namespace {

/// Processor time of this thread, s. Other programs do not change it much, as they do the wall time of a short run.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The mean processor time of some calls. The first one finds nothing in the caches and counts only where it is alone.
/// Short ones are repeated, for at most half of the slice.
template <class Call>
double mean_time(Call&& call, double slice) {
  constexpr int most_calls = 4;
  double first = 0, sum = 0;
  int calls = 0;
  do {
    const double start = processor_seconds();
    call();
    const double seconds = processor_seconds() - start;
    if (++calls == 1) first = seconds;
    else sum += seconds;
  } while (calls < most_calls && (first + sum) * (calls + 1) / calls < slice / 2);
  return calls == 1 ? first : sum / (calls - 1);
}

constexpr double shortest_slice = 3e-4;     // s
constexpr std::size_t most_uses = 1000;     // largest number of uses of a true motion
constexpr double seconds_of_reference = 2;  // assumed time of a reference that takes longer than there is time, s
// Part of a run from which its rate is estimated. The first steps of an adaptive method are small.
constexpr double least_share = 1e-4, least_adaptive_share = 0.05;

/// A run that was carried out, in part or in full.
struct Timed {
  const PlannedRun* run;
  double share;    ///< share of the run that was done, 0 to 1
  double seconds;  ///< time of that share at the mean rate that is expected of the whole run, s
};

/// Times of several kinds.
struct Known {
  double seconds = 0, cost = 0;
  void add(double more_seconds, double more_cost) { seconds += more_seconds, cost += more_cost; }
  double rate() const { return seconds / cost; }
};

/// Runs of one kind.
struct RunKind {
  std::vector<std::size_t> runs;
  double cost = 0;  ///< cost of all runs together
  std::size_t least = 0, largest = 0;
  std::vector<Timed> timed{};
};

bool in_contact(const PlannedRun& run) { return run.config.contact.has_value(); }
double moving_bodies(const PlannedRun& run) { return static_cast<double>(run.scenario->problem.moving()); }

auto kind_key_of(const PlannedRun& run) {
  const RunConfig& config = run.config;
  const ContactConfig none;
  const ContactConfig& contact = config.contact ? *config.contact : none;
  return std::tuple(config.integrator, config.scenario, config.precision, contact.response, contact.impact_timing,
                    contact.narrow_phase, contact.broad_phase, run.scenario->problem.moving(), config.settings,
                    is_compensated(config));
}

/// Method and contact response: kinds that agree in these take similar times for a step of a body.
using ResponseKey = std::pair<std::string, std::string>;
ResponseKey response_key_of(const PlannedRun& run) {
  return {run.config.integrator, in_contact(run) ? run.config.contact->response : std::string()};
}

using KindKey = decltype(kind_key_of(std::declval<const PlannedRun&>()));

std::vector<RunKind> kinds_of(std::span<const PlannedRun* const> runs) {
  std::map<KindKey, RunKind> kinds;
  RunKind* last = nullptr;
  const PlannedRun* before = nullptr;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& run = *runs[i];
    // Runs are sorted: most are of the kind of the one before.
    if (!last || before->config.integrator != run.config.integrator || before->config.scenario != run.config.scenario ||
        before->config.precision != run.config.precision || before->config.settings != run.config.settings ||
        is_compensated(before->config) != is_compensated(run.config) || in_contact(run) ||
        moving_bodies(*before) != moving_bodies(run))
      last = &kinds[kind_key_of(run)];
    before = &run;
    if (last->runs.empty()) last->least = last->largest = i;
    last->runs.push_back(i);
    last->cost += run.cost * moving_bodies(run);
    if (run.cost < runs[last->least]->cost) last->least = i;
    if (run.cost > runs[last->largest]->cost) last->largest = i;
  }
  std::vector<RunKind> all;
  for (auto& [key, kind] : kinds) all.push_back(std::move(kind));
  std::stable_sort(all.begin(), all.end(), [](const RunKind& a, const RunKind& b) { return a.cost > b.cost; });
  return all;
}

/// A true motion that runs share.
using TrueMotionKey = std::pair<const Scenario*, double>;
TrueMotionKey true_motion_key(const PlannedRun& run) { return {run.scenario.get(), run.config.t_end}; }
struct TrueMotionHash {
  std::size_t operator()(const TrueMotionKey& key) const {
    return std::hash<const Scenario*>()(key.first) * 31 + std::hash<double>()(key.second);
  }
};

class Calibration {
 public:
  Calibration(std::span<const PlannedRun* const> runs, std::span<const KnownTime> known, const Timing& timing)
      : runs_(runs), timing_(timing), kinds_(kinds_of(runs)), alarm_(std::max<std::size_t>(timing.workers, 1)) {
    std::map<KindKey, RunKind*> by_key;
    for (RunKind& kind : kinds_) by_key[kind_key_of(*runs_[kind.largest])] = &kind;
    for (const KnownTime& time : known) {
      const auto found = by_key.find(kind_key_of(*time.run));
      if (found != by_key.end()) found->second->timed.push_back({time.run, 1, time.seconds});
    }
  }

  RunTimes run() {
    measure();
    settle();
    RunTimes times;
    times.seconds.reserve(runs_.size());
    times.seconds.resize(runs_.size());
    Known all_kinds;
    std::map<ResponseKey, Known> like;
    for (const RunKind& kind : kinds_) {
      if (kind.timed.empty()) continue;
      const double off = off_the_law(kind);
      double seconds = 0;
      for (const std::size_t i : kind.runs) seconds += times.seconds[i] = off * seconds_of(kind, *runs_[i]);
      all_kinds.add(seconds, kind.cost);
      like[response_key_of(*runs_[kind.largest])].add(seconds, kind.cost);
    }
    const double known = all_kinds.seconds;
    double all = known;
    for (const RunKind& kind : kinds_) {
      if (!kind.timed.empty() || !(all_kinds.cost > 0)) continue;
      const auto found = like.find(response_key_of(*runs_[kind.largest]));
      const double rate = (found != like.end() ? found->second : all_kinds).rate();
      for (const std::size_t i : kind.runs) all += times.seconds[i] = rate * runs_[i]->cost * moving_bodies(*runs_[i]);
    }
    for (double& seconds : times.seconds) {
      if (timing_.best_times && seconds < BestTime::repeated_below) seconds *= BestTime::repetitions;
    }
    times.true_motions = times_of_true_motions(times.seconds);
    times.known = all > 0 ? known / all : 0;
    return times;
  }

 private:
  /// A run that is carried out for a while.
  struct Trial {
    RunKind* kind;
    std::size_t run;
  };

  /// First the largest run of each kind, then the least, then a few between these where runs of the same cost differ:
  /// joints have several stabilizations.
  std::vector<Trial> trials() {
    constexpr std::size_t many = 8, between = 3;
    std::vector<Trial> all;
    std::vector<RunKind*> untimed;
    for (RunKind& kind : kinds_) {
      if (kind.timed.size() < 2) untimed.push_back(&kind);
    }
    for (RunKind* kind : untimed) all.push_back({kind, kind->largest});
    for (RunKind* kind : untimed) {
      if (kind->least != kind->largest) all.push_back({kind, kind->least});
    }
    for (RunKind* kind : untimed) {
      const std::size_t count = kind->runs.size();
      if (count < many || !runs_[kind->largest]->config.joints) continue;
      for (std::size_t k = 0; k < between; ++k) all.push_back({kind, kind->runs[count * (2 * k + 1) / (2 * between)]});
    }
    return all;
  }

  void measure() {
    const std::vector<Trial> work = trials();
    if (work.empty()) return;
    const std::size_t workers = std::min(std::max<std::size_t>(timing_.workers, 1), work.size());
    end_ = Alarm::Clock::now() +
           std::chrono::duration_cast<Alarm::Clock::duration>(std::chrono::duration<double>(timing_.budget));
    std::atomic<std::size_t> next{0};
    const auto worker = [&](std::size_t number) {
      for (std::size_t i = next++; i < work.size(); i = next++) {
        const double left = seconds_left();
        if (left <= 0) return;
        const double share = static_cast<double>(workers) / static_cast<double>(work.size() - i);
        const double slice = left * std::min(share, 1.0);
        time(work[i], std::max(slice, shortest_slice), number);
      }
    };
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < workers; ++k) others.emplace_back(worker, k);
    worker(0);
    for (std::thread& thread : others) thread.join();
  }

  double seconds_left() const { return std::chrono::duration<double>(end_ - Alarm::Clock::now()).count(); }

  void time(const Trial& trial, double slice, std::size_t worker) {
    const PlannedRun& run = *runs_[trial.run];
    bool has_truth = time_true_motion(run, slice, worker);
    const std::vector<const PlannedRun*> batch = batch_of(*trial.kind, trial.run);
    for (const PlannedRun* other : batch) has_truth = has_truth && time_true_motion(*other, slice, worker);
    RunConfig config = run.config;
    if (!has_truth) config.reference = false;
    RunResult result;
    double share_at_half = 0;
    const auto carried_out = [&] {
      Alarm::Watch& watch = alarm_.in(slice, worker);
      const std::atomic<bool>* stop = &watch.stop;
      if (batch.size() == 1 || !has_truth) {
        result = carry_out(config, *run.scenario, {}, stop, &references_, &watch.share);
        // A run that came to its end did not take the whole slice: the half of that is not its own.
        share_at_half = result.status == "interrupted" ? watch.share_at_half.load() : 0;
        return;
      }
      std::vector<LanedRun> lanes;
      for (const PlannedRun* one : batch) lanes.push_back({one->config, *one->scenario});
      const auto keep_first = [&](std::size_t k, RunResult&& one) {
        if (k == 0) result = std::move(one);
      };
      carry_out_together({.runs = lanes, .finish = keep_first, .stop = stop, .references = &references_});
    };
    double seconds = mean_time(carried_out, slice) / (has_truth ? static_cast<double>(batch.size()) : 1);
    const double share = result.status != "interrupted" ? 1 : result.t_reached / run.config.t_end;
    if (share < (run.config.dt ? least_share : least_adaptive_share)) return;
    if (in_contact(run)) seconds = share * time_of_whole(seconds, share, share_at_half);
    const std::lock_guard lock(mutex_);
    trial.kind->timed.push_back({&run, share, seconds});
    if (share == 1) overhead_ = std::min(overhead_, seconds);
  }

  /// Makes the scales and the reference of a run, and takes the time of that if it is the first run that shares them.
  /// A reference may take half of the time left, since no run that needs it gives its time before.
  /// False if there was not enough time for a reference.
  bool time_true_motion(const PlannedRun& run, double slice, std::size_t worker) {
    bool first = false;
    {
      const std::lock_guard lock(mutex_);
      first = known_motions_.insert(true_motion_key(run)).second;
      if (first && run.config.reference) slice = std::max(slice, seconds_left() / 2);
    }
    const std::atomic<bool>* stop = &alarm_.in(slice, worker).stop;
    if (first) time_first_motion(run, slice, stop);
    else references_.of(run.config, *run.scenario, stop);
    if (!*stop) return true;
    if (run.config.reference) return false;
    // The scales of the start: they change the digits of a run and not its time.
    references_.assume(*run.scenario, run.config.t_end, motion_scales(*run.scenario, run.config.t_end, stop));
    return true;
  }

  void time_first_motion(const PlannedRun& run, double slice, const std::atomic<bool>* stop) {
    references_.expect(std::vector<std::uint64_t>(most_uses, number_of(*run.scenario)));
    auto made = [&, known = false]() mutable {
      if (std::exchange(known, true)) References().of(run.config, *run.scenario, stop);
      else references_.of(run.config, *run.scenario, stop);
    };
    const double seconds = mean_time(made, slice);
    const std::lock_guard lock(mutex_);
    MotionTimes& times = motion_times_[run.config.scenario];
    if (*stop) times.cut = true;
    times.sum += *stop && run.config.reference ? seconds_of_reference : seconds;
    ++times.count;
  }

  /// The runs that are carried out together with this one. It stands in for those of other steps or durations.
  std::vector<const PlannedRun*> batch_of(const RunKind& kind, std::size_t index) const {
    constexpr std::size_t most_looked_at = 64;
    const PlannedRun& run = *runs_[index];
    std::vector<const PlannedRun*> batch = {&run};
    if (!timing_.in_lanes || kind.runs.size() == 1) return batch;
    const std::string key = ensemble_key(run.config, *run.scenario, {});
    if (key.empty()) return batch;
    for (std::size_t k = 0; k < std::min(kind.runs.size(), most_looked_at); ++k) {
      const PlannedRun& other = *runs_[kind.runs[k]];
      if (&other == &run || ensemble_key(other.config, *other.scenario, {}) != key) continue;
      const bool as_long = other.config.dt == run.config.dt && other.config.t_end == run.config.t_end;
      batch.push_back(as_long ? &other : &run);
      if (batch.size() == std::size_t(lane_count)) break;
    }
    return batch;
  }

  /// A contact run that was stopped may have ended after its bodies fell and before they rested on each other. It is
  /// compared with the largest run with the same response that came to its end.
  void settle() {
    struct Settled {
      double work = 0, rate = 0;  // cost times bodies; s per unit of that
    };
    std::map<ResponseKey, Settled> rates;  // rate of the largest run that came to its end
    for (const RunKind& kind : kinds_) {
      for (const Timed& timed : kind.timed) {
        if (!in_contact(*timed.run) || timed.share < 1) continue;
        Settled& settled = rates[response_key_of(*timed.run)];
        const double work = timed.run->cost * moving_bodies(*timed.run);
        if (work > settled.work) settled = {work, timed.seconds / work};
      }
    }
    for (RunKind& kind : kinds_) {
      for (Timed& timed : kind.timed) {
        if (!in_contact(*timed.run) || timed.share == 1) continue;
        const auto rate = rates.find(response_key_of(*timed.run));
        if (rate == rates.end()) continue;
        const double settled = rate->second.rate * timed.run->cost * moving_bodies(*timed.run) * timed.share;
        timed.seconds = time_of_falling(timed.seconds, settled);
      }
    }
  }

  /// What the timed runs of a kind took, over what seconds_of() gives for them, which follows two of them.
  double off_the_law(const RunKind& kind) const {
    double taken = 0, by_law = 0;
    for (const Timed& timed : kind.timed) {
      taken += timed.seconds;
      by_law += seconds_of(kind, *timed.run, timed.share);
    }
    return by_law > 0 ? taken / by_law : 1;
  }

  /// Time of this share of a run without repetitions, s.
  double seconds_of(const RunKind& kind, const PlannedRun& run, double share = 1) const {
    return run.config.dt ? seconds_at_step(kind, run, share) : seconds_at_tolerance(kind, run, share);
  }

  /// Time in proportion to the number of steps, with a part that each run has, s.
  double seconds_at_step(const RunKind& kind, const PlannedRun& run, double share) const {
    const auto done = [](const Timed& timed) { return timed.run->cost * timed.share; };
    const auto [low, high] = std::minmax_element(kind.timed.begin(), kind.timed.end(),
                                                 [&](const Timed& a, const Timed& b) { return done(a) < done(b); });
    double fixed = std::min(overhead_, low->seconds), rate = (high->seconds - fixed) / done(*high);
    if (done(*high) > done(*low) && high->seconds > low->seconds) {
      const double slope = (high->seconds - low->seconds) / (done(*high) - done(*low));
      const double rest = low->seconds - slope * done(*low);
      if (rest > 0) rate = slope, fixed = rest;
    }
    return fixed + rate * run.cost * share;
  }

  /// Time in proportion to the duration, and by a power of the tolerance, s.
  double seconds_at_tolerance(const RunKind& kind, const PlannedRun& run, double share) const {
    const auto rate = [&](const Timed& timed) {  // logarithm of the rate
      const double least = timed.seconds / 10;
      return std::log(std::max(timed.seconds - overhead_, least) / (timed.share * timed.run->config.t_end));
    };
    const auto place = [](const PlannedRun& one) { return std::log(*one.config.tolerance); };
    const auto [low, high] =
        std::minmax_element(kind.timed.begin(), kind.timed.end(),
                            [&](const Timed& x, const Timed& y) { return place(*x.run) < place(*y.run); });
    const Timed &a = *low, &b = *high;
    double at = rate(a);
    if (place(*a.run) != place(*b.run))
      at += (rate(b) - rate(a)) * (place(run) - place(*a.run)) / (place(*b.run) - place(*a.run));
    else at += std::log(run.cost / run.config.t_end / (a.run->cost / a.run->config.t_end));
    return std::min(overhead_, a.seconds) + std::exp(at) * run.config.t_end * share;
  }

  /// RunTimes::true_motions. `seconds`: the times of the runs.
  std::vector<double> times_of_true_motions(const std::vector<double>& seconds) const {
    std::vector<double> all(runs_.size());
    const std::map<ResponseKey, double> prices = prices_of_contact_scales(seconds);
    std::unordered_map<TrueMotionKey, bool, TrueMotionHash> met;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const PlannedRun& run = *runs_[i];
      if (!met.emplace(true_motion_key(run), true).second) continue;
      const auto found = motion_times_.find(run.config.scenario);
      if (found == motion_times_.end()) continue;
      const MotionTimes& times = found->second;
      if (times.cut && in_contact(run) && run.config.dt) {
        const auto price = prices.find(response_key_of(run));
        all[i] = seconds[i] * share_of_contact_scales(run) * (price == prices.end() ? 1 : price->second);
      } else {
        all[i] = times.sum / times.count;
      }
    }
    return all;
  }

  /// Steps of the motion that gives the scales of a contact run, in those of the run.
  static double share_of_contact_scales(const PlannedRun& run) {
    return steps_of_contact_scales(*run.scenario, run.config.t_end) / std::ceil(run.config.t_end / *run.config.dt);
  }

  /// Time of a step of the motion that gives the scales, in that of a step of the run: of the longest run of each
  /// response whose scales were made in their time. Longer steps press bodies deeper into each other.
  std::map<ResponseKey, double> prices_of_contact_scales(const std::vector<double>& seconds) const {
    std::map<ResponseKey, double> prices, longest;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const PlannedRun& run = *runs_[i];
      const auto found = motion_times_.find(run.config.scenario);
      if (!in_contact(run) || !run.config.dt || found == motion_times_.end() || found->second.cut) continue;
      double& largest = longest[response_key_of(run)];
      if (seconds[i] <= largest) continue;
      largest = seconds[i];
      prices[response_key_of(run)] =
          found->second.sum / found->second.count / (seconds[i] * share_of_contact_scales(run));
    }
    return prices;
  }

  struct MotionTimes {
    double sum = 0, count = 0;
    bool cut = false;  ///< one was not finished in its time
  };

  std::span<const PlannedRun* const> runs_;
  Timing timing_;
  std::vector<RunKind> kinds_;
  References references_;
  std::mutex mutex_;
  std::set<TrueMotionKey> known_motions_;
  std::map<std::string, MotionTimes> motion_times_;  // times of the motions by scenario
  Alarm::Clock::time_point end_{};                   // end of the time for all runs
  double overhead_ = 2e-4;                           // overhead of each run, s
  Alarm alarm_;
};

}  // namespace

RunTimes run_times(std::span<const PlannedRun* const> runs, std::span<const KnownTime> known, const Timing& timing) {
  if (runs.empty()) return {};
  return Calibration(runs, known, timing).run();
}

double time_of_whole(double seconds, double share, double share_at_half) {
  if (share >= 1) return seconds;
  if (!(share_at_half > 0 && share > share_at_half)) return seconds / share;
  return seconds + (1 - share) * (seconds / 2) / (share - share_at_half);
}

double time_of_falling(double seen, double settled) { return settled > seen ? std::sqrt(seen * settled) : seen; }

double time_of_all(const RunTimes& times, double runs, double true_motions, std::size_t workers) {
  if (times.seconds.empty()) return 0;
  const double of_each = runs / static_cast<double>(times.seconds.size());
  std::vector<double> seconds = times.seconds;
  if (of_each == 1) {
    for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] += times.true_motions[i];
    return time_of_workers(seconds, workers);
  }
  double met = 0, made = 0;  // true motions of the choice, and their time, s
  for (const double time : times.true_motions) met += time > 0, made += time;
  const double motions = std::clamp(true_motions, met, std::max(runs, met));
  const double of_motions = met > 0 ? made / met * motions : 0;
  return time_of_workers(seconds, workers) * of_each +
         of_motions / static_cast<double>(std::max<std::size_t>(workers, 1));
}

double time_of_workers(std::span<const double> seconds, std::size_t workers) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free;  // times at which the workers become free
  for (std::size_t k = 0; k < std::max<std::size_t>(workers, 1); ++k) free.push(0);
  double end = 0;
  for (const double time : seconds) {
    const double done = free.top() + time;
    free.pop();
    free.push(done);
    end = std::max(end, done);
  }
  return end;
}

}  // namespace polhode::study::workers
