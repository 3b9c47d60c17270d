// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/time_needed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "core/exact/exact_motion.hpp"
#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plan/deal.hpp"
#include "experiments/study/plot/draw_figures.hpp"
#include "experiments/study/process/progress.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/text/in_order.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "experiments/study/workers/run_times.hpp"

namespace polhode::study {
namespace {

constexpr std::size_t most_looked_up = 500;  // stored wall times that are read
constexpr std::size_t most_drawn = 5000;     // runs of one body that are taken for the figures
constexpr std::size_t most_timed = 10'000;   // runs whose times are summed up; others take as long in the mean
constexpr double budget_of_a_glance = 0.25;  // s; with the plan itself and twice this the answer takes less than 1 s
// Time for which runs of a long study are timed, over the time of its runs, and the most of it, s. A machine changes
// its speed from one tenth of a second to the next.
constexpr double share_of_long_study = 0.2, most_of_long_study = 2;

// Times measured where a number is written in `usual_number` and gnuplot starts in `usual_start`, s.
constexpr double usual_number = 4.4e-8;
constexpr double usual_start = 0.01;
constexpr double fixed_work = 0.04;             // start, store, summary, page
constexpr double work_of_a_run = 8e-5;          // its rows in the store, in tables and in the page
constexpr double work_of_a_run_of_many = 2e-5;  // the same where runs are too many to be held, on all threads
constexpr double work_of_a_figure = 0.022;      // a start of gnuplot
constexpr double work_of_a_panel = 0.0035;
constexpr double work_of_a_point = 2e-5;
constexpr double figures_at_a_time = 2;
constexpr double drawn_like_a_start = 0.8;  // share of the time of panels and points that a slow system prolongs

/// Time in which this machine writes a number as text, s.
double time_of_a_number() {
  constexpr int trials = 5, numbers = 2000;
  double least = std::numeric_limits<double>::infinity();
  std::string text;
  for (int trial = 0; trial < trials; ++trial) {
    text.clear();
    const auto start = std::chrono::steady_clock::now();
    for (int i = 1; i <= numbers; ++i) text += exact(std::sqrt(i));
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return text.empty() ? usual_number : least / numbers;
}

/// Short times with two digits.
std::string text_of_time(double seconds) {
  return seconds < 9.95 ? fmt::format("{:.{}f} s", std::max(seconds, 0.01), seconds < 1 ? 2 : 1)
                        : duration_text(seconds);
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A result with everything that figures may show.
RunResult full_result(const PlannedRun& run, bool known_motion, bool keeps_curves) {
  RunResult result;
  result.status = "ok";
  result.t_reached = run.config.t_end;
  result.energy_drift_max_rel = result.linear_momentum_drift_max_rel = result.angular_momentum_drift_max_rel =
      result.orientation_defect_max = 1e-3;
  if (known_motion) result.attitude_error_max = result.position_error_max = 1e-3;
  for (const std::string& name : run.scenario->invariants) result.invariant_drift_max_rel[name] = 1e-3;
  constexpr double most_points = 256;
  const double steps = run.config.samples ? static_cast<double>(*run.config.samples)
                       : run.config.dt    ? run.config.t_end / *run.config.dt
                                          : most_points;
  const auto points = static_cast<std::size_t>(std::clamp(steps, 1.0, most_points));
  if (keeps_curves) result.series.assign(points, {1, 1e-3, 1e-3, 1e-3, 1e-3});
  return result;
}

/// `most` runs of one body, fewer of several: to read the scenario of a run takes longer the more bodies it has.
std::size_t number_to_read(const Plan& plan, std::size_t most) {
  constexpr std::size_t fewest = 100;
  const auto accepted =
      std::find_if(plan.rows.begin(), plan.rows.end(), [](const PlanRow& row) { return !row.refused; });
  if (accepted == plan.rows.end()) return 0;
  const auto first = static_cast<std::size_t>(accepted - plan.rows.begin());
  return std::max(fewest, most / std::max<std::size_t>(plan.run(first).scenario->problem.bodies.size(), 1));
}

/// The figures that the study would have if all runs came to their end.
FigureSet usual_figures(const Plan& plan) {
  StudyView view;
  view.scenarios = plan.scenarios;
  view.varied_keys = plan.varied_keys;
  view.named = plan.named;
  view.invariants = plan.invariants;
  std::map<std::string, bool> known;
  Variants variants;
  for (const std::size_t i : evenly_spread(plan.size(), number_to_read(plan, most_drawn))) {
    if (plan.rows[i].refused) continue;
    const PlannedRun run = plan.run(i, &variants);
    const auto [found, added] = known.try_emplace(run.config.scenario, run.config.reference);
    if (added && run.scenario->colliders.empty())
      found->second = found->second || ExactMotion(*make_system<double>(run.scenario->problem, {})).is_complete();
    view.runs.push_back({run.id, run.config, full_result(run, found->second, plan.rows[i].keeps_curves), run.scenario});
  }
  return figures_of(view, group(view));
}

/// How long this machine takes, over the time that was usual where the constants above were measured.
struct Slowness {
  double of_numbers = 1;  ///< to write a number as text
  double of_starts = 1;   ///< to start gnuplot
};

double time_of_figures(const Experiment& experiment, const Plan& plan, const Slowness& slowness) {
  auto figures = static_cast<double>(experiment.needs.figures);
  double panels = 4 * figures, points = 0;
  if (!experiment.analysis_alone) {
    for (const Figure& figure : usual_figures(plan).figures) {
      figures += 1;
      panels += static_cast<double>(figure.panels.size());
      for (const Panel& panel : figure.panels) {
        for (const PlottedCurve& curve : panel.curves) points += static_cast<double>(curve.points.size());
      }
    }
  }
  const double of_drawing = std::lerp(slowness.of_numbers, slowness.of_starts, drawn_like_a_start);
  const double work = work_of_a_figure * figures * slowness.of_starts +
                      (work_of_a_panel * panels + work_of_a_point * points) * of_drawing;
  return work / std::clamp<double>(std::thread::hardware_concurrency(), 1, figures_at_a_time);
}

/// The time after the runs on this machine, besides the analysis, s.
double time_after_runs(const Experiment& experiment, const Options& options, const Plan& plan) {
  const double planned = static_cast<double>(plan.size()) * plan.runs_of_a_row;
  const double runs = planned * (1 + experiment.needs.refined);
  const double of_a_run = is_held(experiment, static_cast<std::size_t>(planned))
                              ? work_of_a_run
                              : work_of_a_run_of_many / static_cast<double>(number_of_threads(options.jobs));
  Slowness slowness;
  slowness.of_numbers = time_of_a_number() / usual_number;
  const double own = (fixed_work + of_a_run * runs) * slowness.of_numbers;
  const std::optional<double> start = options.figures ? time_of_gnuplot() : std::nullopt;
  if (!start) return own;
  slowness.of_starts = *start / usual_start;
  return own + time_of_figures(experiment, plan, slowness);
}

/// Finished runs with their wall times, of an even choice of these.
struct StoredTimes {
  std::vector<PlannedRun> runs;
  std::vector<double> seconds;
};

StoredTimes stored_times(const Plan& plan, const std::vector<std::filesystem::path>& folders,
                         const std::vector<std::uint64_t>& done) {
  std::vector<std::size_t> there;
  for (const std::uint64_t id : done) {
    if (const auto i = plan.find(id)) there.push_back(*i);
  }
  std::sort(there.begin(), there.end());
  StoredTimes times;
  if (there.empty()) return times;
  std::vector<std::unique_ptr<const Store>> stores;
  for (const auto& folder : folders)
    stores.push_back(std::make_unique<const Store>(folder, metric_table(), Access::look));
  Variants variants;
  for (const std::size_t k : evenly_spread(there.size(), most_looked_up)) {
    PlannedRun run = plan.run(there[k], &variants);
    std::optional<StoredRun> stored;
    for (auto store = stores.begin(); store != stores.end() && !stored; ++store)
      stored = (*store)->find(run.id, Curves::without);
    if (!stored || !stored->damage.empty() || !(stored->result.seconds > 0)) continue;
    times.runs.push_back(std::move(run));
    times.seconds.push_back(stored->result.seconds);
  }
  return times;
}

}  // namespace

std::string time_needed_text(const Experiment& experiment, const Options& options, const Plan& plan,
                             const std::vector<std::filesystem::path>& stores, const std::vector<std::uint64_t>& done) {
  std::vector<std::size_t> missing;
  std::size_t there = 0;
  const auto shards = options.shard ? deal(plan, options.shard->count) : std::vector<std::size_t>();
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan.rows[i].refused) continue;
    if (std::binary_search(done.begin(), done.end(), plan.rows[i].id)) ++there;
    else if (!options.merge && (!options.shard || shards[i] == options.shard->number)) missing.push_back(i);
  }
  std::vector<PlannedRun> runs;
  Variants variants(most_timed);
  for (const std::size_t k : evenly_spread(missing.size(), number_to_read(plan, most_timed)))
    runs.push_back(plan.run(missing[k], &variants));
  std::vector<const PlannedRun*> timed;
  for (const PlannedRun& run : runs) timed.push_back(&run);
  std::stable_sort(timed.begin(), timed.end(),
                   [](const PlannedRun* a, const PlannedRun* b) { return a->cost > b->cost; });  // run_all() does so
  const StoredTimes stored = stored_times(plan, stores, done);
  std::vector<KnownTime> known;
  for (std::size_t k = 0; k < stored.runs.size(); ++k) known.push_back({&stored.runs[k], stored.seconds[k]});
  Timing timing;
  timing.best_times = experiment.best_times;
  timing.in_lanes = options.trajectory == TrajectoryFormat::none;
  timing.workers = number_of_threads(options.jobs);
  if (plan.runs_of_a_row > 1) timing.budget = budget_of_a_glance;
  const Experiment::Needs& needs = experiment.needs;
  RunTimes times;
  double running = 0;
  const auto time_runs = [&] {
    times = run_times(timed, known, timing);
    running = (1 + needs.refined) * time_of_all(times, static_cast<double>(missing.size()) * plan.runs_of_a_row,
                                                plan.most_true_motions(), timing.workers);
  };
  time_runs();
  const double longer =
      times.known > 0 ? std::min(running * share_of_long_study, most_of_long_study) : most_of_long_study;
  if (plan.runs_of_a_row == 1 && !runs.empty() && longer > timing.budget) {
    timing.budget = longer;
    time_runs();
  }
  const double stored_times = mean(stored.seconds) * static_cast<double>(there);
  const double analysis = needs.analysis * (running + stored_times / static_cast<double>(timing.workers));
  const double after = options.shard ? 0 : analysis + time_after_runs(experiment, options, plan);
  if (times.known == 0 && !missing.empty())
    return fmt::format("at least {} with {} job{}: no run came far enough in {} to tell its time\n",
                       text_of_time(running + after), timing.workers, timing.workers == 1 ? "" : "s",
                       text_of_time(timing.budget));
  std::string text = fmt::format("about {} with {} job{}", text_of_time(running + after), timing.workers,
                                 timing.workers == 1 ? "" : "s");
  if (!options.shard) text += fmt::format(", of which {} after the runs", text_of_time(after));
  if (times.known < 0.995 && !missing.empty())
    text += fmt::format("; {:.0f} % of this is known from timed runs, and guessed from them for the rest",
                        100 * times.known);
  return text + "\n";
}

}  // namespace polhode::study
