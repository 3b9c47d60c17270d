// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "experiments/study/interruption.hpp"
#include "experiments/study/metrics/references.hpp"
#include "experiments/study/plan/deal.hpp"
#include "experiments/study/plan/listing.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/plan_text.hpp"
#include "experiments/study/progress.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "experiments/study/report/tables/results.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/slurm.hpp"
#include "experiments/study/store/result_folder.hpp"
#include "experiments/study/store/shard_folders.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/program.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "experiments/study/time_needed.hpp"
#include "experiments/study/workers.hpp"

namespace polhode::study {
namespace {

std::filesystem::path folder_of(const Experiment& experiment, const Options& options, const Plan& plan) {
  if (!options.out.empty()) return options.out;
  const std::string what =
      plan.scenarios.size() == 1 ? plan.scenarios[0].name : std::to_string(plan.scenarios.size()) + "_scenarios";
  return std::filesystem::path("results") / (experiment.name + "-" + what + "-" + plan.identity.substr(0, 8));
}

TrajectoryRequest trajectory_of(const Experiment& experiment, const Options& options,
                                const std::filesystem::path& folder, const std::string& id) {
  return {options.trajectory, experiment.one_run ? folder : folder / "trajectories" / id};
}

/// Chooses the runs whose curves against time are kept.
void choose_curves(const Options& options, Plan& plan) {
  std::vector<const RunConfig*> runs;
  for (PlannedRun& run : plan.runs) {
    run.keeps_curves = false;
    runs.push_back(&run.config);
  }
  for (const std::size_t i : shown_runs(runs, options.curves.value_or(runs.size()))) plan.runs[i].keeps_curves = true;
}

void drop_curves(RunResult& result) {
  result.series = std::vector<SeriesPoint>();  // unlike = {}, this frees the memory
  result.attitude_errors = std::vector<AttitudeError>();
}

/// True if the result has all that is kept of it. A run that took no step has no curves.
bool is_complete(const RunResult& result, const PlannedRun& run) {
  return !run.keeps_curves || !result.series.empty() || result.steps == 0;
}

/// Groups runs of equal key into batches of at most lane_count runs, in their order. Runs with an empty key are batches
/// of one.
template <class Key>
std::vector<Batch> batches_of(const std::vector<const PlannedRun*>& runs, const Key& key_of) {
  std::vector<Batch> batches;
  std::map<std::string, std::size_t> open;
  for (const PlannedRun* run : runs) {
    const std::string key = key_of(*run);
    const auto found = open.find(key);
    if (key.empty() || found == open.end() || batches[found->second].size() == std::size_t(lane_count)) {
      open[key] = batches.size();
      batches.push_back({run});
    } else {
      batches[found->second].push_back(run);
    }
  }
  return batches;
}

/// Carries out one run. If the experiment requires best times, a run shorter than 0.04 s is repeated and the least time
/// kept, since disturbances by other programs only increase it.
RunResult carry_out_alone(const Experiment& experiment, const PlannedRun& run, const TrajectoryRequest& trajectory,
                          References& references, Interruption& interruption, std::atomic<double>& share) {
  constexpr double long_enough = 0.04;  // s
  constexpr int most_times = 5;
  const std::atomic<bool>* stop = &interruption.stop();
  RunResult result = carry_out(run.config, *run.scenario, trajectory, stop, &references, &share);
  for (int k = 1; k < most_times && experiment.best_times && result.seconds < long_enough && !*stop; ++k) {
    const RunResult again = carry_out(run.config, *run.scenario, {}, stop, &references);
    if (again.status == result.status) result.seconds = std::min(result.seconds, again.seconds);
  }
  return result;
}

/// Result of a run of the plan; null if there is none, or if a part of it is missing.
const RunResult* result_of(const std::map<std::string, RunResult>& results, const PlannedRun& run,
                           const TrajectoryRequest& wanted) {
  const auto found = results.find(run.id);
  const bool whole =
      found != results.end() && is_complete(found->second, run) && has_trajectory(wanted.format, wanted.folder);
  return whole ? &found->second : nullptr;
}

/// Number of runs of the plan without a result.
std::size_t missing_runs(const Experiment& experiment, const Options& options, const Plan& plan,
                         const std::filesystem::path& folder, const std::map<std::string, RunResult>& results) {
  return static_cast<std::size_t>(std::count_if(plan.runs.begin(), plan.runs.end(), [&](const PlannedRun& run) {
    return run.refusal.empty() && !result_of(results, run, trajectory_of(experiment, options, folder, run.id));
  }));
}

/// Carries out the runs that the store does not contain yet; of a shard its own. Returns false if interrupted.
bool carry_out_missing(const Experiment& experiment, const Options& options, const Plan& plan,
                       const std::filesystem::path& folder, Store& store, std::map<std::string, RunResult>& results,
                       Interruption& interruption, bool say_what_is_there) {
  std::vector<const PlannedRun*> missing;
  const std::vector<std::size_t> shards = options.shard ? deal(plan, options.shard->count) : std::vector<std::size_t>();
  std::size_t elsewhere = 0;  // missing runs of other shards
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    const bool done = result_of(results, run, trajectory_of(experiment, options, folder, run.id)) != nullptr;
    if (!run.refusal.empty() || done) continue;
    if (options.shard && shards[i] != options.shard->number) ++elsewhere;
    else missing.push_back(&run);
  }
  if (missing.empty()) return true;
  const std::size_t kept = plan.runs.size() - missing.size() - elsewhere;
  if (!results.empty() && say_what_is_there) {
    fmt::print(stderr, "{}: {} of {} runs are there already\n", experiment.name, kept, plan.runs.size());
  }
  References references;
  for (const PlannedRun* run : missing) references.expect(run->config, *run->scenario);
  const auto trajectory = [&](const PlannedRun& run) { return trajectory_of(experiment, options, folder, run.id); };
  const auto finish = [&](const std::vector<RunRecord>& runs) {
    std::vector<std::filesystem::path> folders;
    for (const RunRecord& run : runs) folders.push_back(trajectory_of(experiment, options, folder, run.id).folder);
    finish_trajectories(options.trajectory, folders);
  };
  const auto carry_out_batch = [&](const Batch& batch, std::atomic<double>& share) -> std::vector<RunResult> {
    if (batch.size() == 1) {
      const PlannedRun& run = *batch.front();
      return {carry_out_alone(experiment, run, trajectory(run), references, interruption, share)};
    }
    std::vector<LanedRun> runs;
    for (const PlannedRun* run : batch) runs.push_back({run->config, *run->scenario});
    return carry_out_together(runs, &interruption.stop(), &references);
  };
  const auto work = [&](const Batch& batch, std::atomic<double>& share) {
    std::vector<RunResult> done = carry_out_batch(batch, share);
    for (std::size_t i = 0; i < done.size(); ++i) {
      if (!batch[i]->keeps_curves) drop_curves(done[i]);
    }
    return done;
  };
  const auto key = [&](const PlannedRun& run) { return ensemble_key(run.config, *run.scenario, trajectory(run)); };
  const std::string name = options.shard
                               ? fmt::format("{} {}/{}", experiment.name, options.shard->number, options.shard->count)
                               : experiment.name;
  run_all(name, batches_of(missing, key), work, finish, options.jobs, store, interruption.no_more(), results);
  if (!interruption.no_more()) return true;
  const auto here =
      std::count_if(plan.runs.begin(), plan.runs.end(), [&](const auto& r) { return results.contains(r.id); });
  fmt::print(stderr, "{}: interrupted; {} of {} runs are kept in {}; the same command goes on from there\n",
             experiment.name, here, plan.runs.size(), folder.string());
  return false;
}

/// The finished study. `give` moves or copies a result out of the map.
template <class Results, class Give>
StudyView view_of(const Experiment& experiment, const Options& options, const Plan& plan,
                  const std::filesystem::path& folder, Results& results, const Give& give) {
  StudyView view;
  view.experiment = experiment.name;
  view.question = experiment.question;
  view.command = options.command;
  view.scenarios = plan.scenarios;
  view.varied_keys = plan.varied_keys;
  view.named = plan.named;
  view.invariants = plan.invariants;
  view.folder = folder;
  view.durations_follow_steps = static_cast<bool>(experiment.duration);
  for (const PlannedRun& run : plan.runs) {
    RunRecord record{run.id, run.config, {}, run.scenario};
    if (!run.refusal.empty()) {
      record.result.status = "refused";
      record.result.message = run.refusal;
    } else {
      record.result = give(results.at(run.id));
      if (!run.keeps_curves) drop_curves(record.result);
    }
    view.runs.push_back(std::move(record));
  }
  return view;
}

/// Adds the further runs that the experiment requests, given the results of the plan. Returns false if there are none.
bool widened(const Experiment& experiment, const Options& options, Plan& plan, const std::filesystem::path& folder,
             const std::map<std::string, RunResult>& results) {
  if (!experiment.refine) return false;
  const auto copy = [](const RunResult& result) { return result; };
  if (widen(plan, experiment.refine(view_of(experiment, options, plan, folder, results, copy))) == 0) return false;
  choose_curves(options, plan);
  return true;
}

/// Ids of the runs of the study, including further runs requested on the basis of results already in its folder. Plans
/// these even if some results are missing, because the study was interrupted or has more runs than before. Changes no
/// file.
std::set<std::string> ids_of(const Experiment& experiment, const Options& options, Plan plan,
                             const std::filesystem::path& folder) {
  std::map<std::string, RunResult> results;
  std::vector<std::filesystem::path> stores = shard_folders(folder);
  stores.push_back(folder);
  for (const auto& place : stores) {
    try {
      if (experiment.refine && !Store::ids_in(place).empty())
        results.merge(Store(place, metric_table(), Access::write).load().runs);
    } catch (const std::runtime_error&) {  // ResultFolder reports the error
    }
  }
  std::set<std::string> ids;
  for (std::size_t known = 0;;) {
    for (const PlannedRun& run : plan.runs) ids.insert(run.id);
    if (ids.size() == known || !experiment.refine) return ids;
    known = ids.size();
    std::erase_if(plan.runs, [&](const PlannedRun& run) { return run.refusal.empty() && !results.contains(run.id); });
    widened(experiment, options, plan, folder, results);
  }
}

void write_everything(const StudyView& view, const Options& options, const Plan& plan) {
  write_runs_csv(view);
  write_timings_csv(view);
  write_manifest(view, options, plan);
  write_tables(view);
  if (options.figures) {
    const std::string skipped = write_figures(view);
    if (!skipped.empty()) fmt::print(stderr, "{}: {}\n", view.experiment, skipped);
  }
  write_report(view);
}

/// The results in the store, except those of runs to be carried out again: damaged rows and, with --force, failed runs.
std::map<std::string, RunResult> stored(const Experiment& experiment, const Options& options,
                                        const std::filesystem::path& folder, Store& store) {
  auto [runs, damaged] = store.load();
  if (!damaged.empty()) {
    fmt::print(stderr, "{}: {}: {} of {} runs are damaged and carried out again (the first: run {}, {})\n",
               experiment.name, (folder / Store::file_name).string(), damaged.size(), damaged.size() + runs.size(),
               damaged.begin()->first, damaged.begin()->second);
  }
  for (const auto& [id, why] : damaged) store.forget(id);
  if (options.force) std::erase_if(runs, [](const auto& run) { return run.second.status == "failed"; });
  return std::move(runs);
}

/// Message about runs of one status: "2 of 51 runs failed, the first with: out of memory"; empty if there are none.
std::string missed_text(const std::vector<const RunRecord*>& missed, std::size_t runs, const std::string& status) {
  const auto is_so = [&](const RunRecord* run) { return run->result.status == status; };
  const auto first = std::find_if(missed.begin(), missed.end(), is_so);
  if (first == missed.end()) return {};
  const auto count = std::count_if(missed.begin(), missed.end(), is_so);
  std::string text = fmt::format("{} of {} run{} {}{}: {}", count, runs, runs == 1 ? "" : "s", status,
                                 count > 1 ? ", the first with" : "", (*first)->result.message);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Results in the other stores of the study: in those of shards and, for a shard, in that of the study. A store that
/// cannot be read, since its shard is under way on a network file system, is named and left out.
std::map<std::string, RunResult> results_elsewhere(const Experiment& experiment, const std::filesystem::path& folder,
                                                   const std::filesystem::path& own) {
  std::vector<std::filesystem::path> stores = shard_folders(folder);
  if (std::filesystem::exists(folder / Store::file_name)) stores.push_back(folder);
  std::erase(stores, own);
  std::map<std::string, RunResult> results;
  for (const auto& place : stores) {
    try {
      if (Store::ids_in(place).empty()) continue;  // a shard that has just begun
      const Store store(place, metric_table(), Access::read);
      store.for_each(Curves::with, [&](StoredRun&& run) {
        if (run.damage.empty()) results.emplace(run.id, std::move(run.result));
      });
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "{}: left out: {}\n", experiment.name, error.what());
    }
  }
  return results;
}

/// Moves results of the plan's runs from other stores into this one.
void join(const Plan& plan, std::map<std::string, RunResult>& elsewhere, Store& store,
          std::map<std::string, RunResult>& results) {
  constexpr std::size_t at_a_time = 1000;
  std::vector<RunRecord> records;
  const auto keep = [&] {
    store.keep(records);
    for (RunRecord& record : records) results[record.id] = std::move(record.result);
    records.clear();
  };
  for (const PlannedRun& run : plan.runs) {
    const auto found = elsewhere.find(run.id);
    const auto here = results.find(run.id);
    if (found == elsewhere.end() || (here != results.end() && is_complete(here->second, run))) continue;
    records.push_back({run.id, run.config, std::move(found->second)});
    elsewhere.erase(found);
    if (records.size() == at_a_time) keep();
  }
  keep();
}

/// Carries out a shard, in a folder of its own.
int run_shard(const Experiment& experiment, const Options& options, Plan plan, const std::filesystem::path& folder) {
  const std::filesystem::path own = shard_folder(folder, options.shard->number, options.shard->count);
  const std::set<std::string> ids = ids_of(experiment, options, plan, folder);
  if (!options.force) refuse_other_study(folder, ids);
  const ResultFolder held(own, ids, options.force);
  Interruption interruption;
  Store store(own);
  store.keep_scenarios(plan.scenarios);
  auto results = stored(experiment, options, own, store);
  results.merge(results_elsewhere(experiment, folder, own));
  bool first = true;
  std::size_t missing = 0;
  do {
    if (!carry_out_missing(experiment, options, plan, folder, store, results, interruption, first)) return interrupted;
    first = false;
    missing = missing_runs(experiment, options, plan, folder, results);
  } while (missing == 0 && widened(experiment, options, plan, folder, results));
  fmt::print("{}: shard {}/{} is done: {} of {} runs of the study are there; --merge joins all shards\n",
             experiment.name, options.shard->number, options.shard->count, plan.runs.size() - missing,
             plan.runs.size());
  return 0;
}

/// Writes the job scripts of the study, and submits them if asked to.
int prepare_jobs(const Experiment& experiment, const Options& options, const Plan& plan,
                 const std::filesystem::path& folder) {
  const SlurmJobs jobs = read_slurm_jobs(*options.slurm, plan.runs.size());
  if (!options.force) refuse_other_study(folder, ids_of(experiment, options, plan, folder));
  write_job_scripts(jobs, experiment.name, options.words, folder);
  fmt::print("{}: {} runs in {} shards; submit with {}, or carry out with {}\n", experiment.name, plan.runs.size(),
             jobs.shards, (folder / "slurm/submit.sh").string(), (folder / "slurm/parallel.sh").string());
  if (options.submit) fmt::print("{}", submit_jobs(folder));
  return 0;
}

int run_study(const Experiment& experiment, const Options& options) {
  Plan plan = make_plan(experiment, options);
  choose_curves(options, plan);
  const std::filesystem::path folder = folder_of(experiment, options, plan);
  if (options.dry_run) {
    const std::set<std::string> done = Store::ids_in(folder);
    fmt::print("{}{}", plan_text(experiment, plan, folder, done),
               time_needed_text(experiment, options, plan, folder, done));
    return 0;
  }
  if (options.slurm) return prepare_jobs(experiment, options, plan, folder);
  if (options.shard) return run_shard(experiment, options, std::move(plan), folder);
  const std::set<std::string> ids = ids_of(experiment, options, plan, folder);
  const ResultFolder held(folder, ids, options.force);
  Interruption interruption;
  Store store(folder);
  store.keep_scenarios(plan.scenarios);
  auto results = stored(experiment, options, folder, store);
  auto elsewhere = results_elsewhere(experiment, folder, folder);
  bool first = true;
  do {
    join(plan, elsewhere, store, results);
    if (options.merge) {
      if (const std::size_t missing = missing_runs(experiment, options, plan, folder, results)) {
        fmt::print(stderr,
                   "{}: {} of {} runs are missing in {} and its shards; the same command without --merge, or with "
                   "--shard, carries them out\n",
                   experiment.name, missing, plan.runs.size(), folder.string());
        return interrupted;
      }
    } else if (!carry_out_missing(experiment, options, plan, folder, store, results, interruption, first)) {
      return interrupted;
    }
    first = false;
  } while (widened(experiment, options, plan, folder, results));
  interruption.study_is_stored();
  const auto take = [](RunResult& result) { return std::move(result); };
  StudyView view = view_of(experiment, options, plan, folder, results, take);
  if (experiment.analysis) view.analysis = experiment.analysis(view);
  write_everything(view, options, plan);
  store.keep_study(view.experiment, view.command, read_file(folder / "manifest.json").value_or(""));
  fmt::print("{}\n{}\n", summary_table(view), (folder / "report.html").string());
  // A refused run is no error if the report shows the analysis alone: the refusal is part of its answer.
  const bool answers_refusals = view.analysis && view.analysis->alone;
  std::vector<const RunRecord*> missed;
  for (const RunRecord& run : view.runs) {
    const bool refused = run.result.status == "refused" && !answers_refusals;
    const bool failed = run.result.status == "failed" && !experiment.failures_are_results;
    if (refused || failed) missed.push_back(&run);
  }
  if (missed.empty()) return 0;
  std::string text = missed_text(missed, view.runs.size(), "failed");
  const std::string refused = missed_text(missed, view.runs.size(), "refused");
  if (!refused.empty()) text += (text.empty() ? "" : "; ") + refused;
  fmt::print(stderr, "{}: {}\n", experiment.name, text);
  return not_carried_out;
}

}  // namespace

int run_experiment(const Experiment& experiment, int argc, const char* const* argv) {
  const auto program = [&] {
    const ParsedOptions parsed = parse_options(experiment, argc, argv);
    if (parsed.exit_status) return *parsed.exit_status;
    if (parsed.options.list) {
      fmt::print("{}", listing(*parsed.options.list));
      return 0;
    }
    return run_study(experiment, parsed.options);
  };
  return run_program(experiment.name, program, "; finished runs are kept, and the same command goes on from there");
}

}  // namespace polhode::study
