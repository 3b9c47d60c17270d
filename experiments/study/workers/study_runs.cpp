// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/plan/deal.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/store/shard_folders.hpp"
#include "experiments/study/trajectory/quick_look.hpp"
#include "experiments/study/trajectory/trajectory_files.hpp"
#include "experiments/study/workers/workers.hpp"

namespace polhode::study::inline workers {
namespace {

std::filesystem::path trajectory_folder(const Experiment& experiment, const std::filesystem::path& folder,
                                        const std::string& id) {
  return experiment.one_run ? folder : folder / "trajectories" / id;
}

/// Carries out one run, repeatedly if it is short and the experiment requires best times.
RunResult carry_out_alone(const Experiment& experiment, const PlannedRun& run, const TrajectoryRequest& trajectory,
                          References& references, Interruption& interruption, std::atomic<double>& share) {
  const std::atomic<bool>* stop = &interruption.stop();
  RunResult result = carry_out(run.config, *run.scenario, trajectory, stop, &references, &share);
  for (int k = 1;
       k < BestTime::repetitions && experiment.best_times && result.seconds < BestTime::repeated_below && !*stop; ++k) {
    const RunResult again = carry_out(run.config, *run.scenario, {}, stop, &references);
    if (again.status == result.status) result.seconds = std::min(result.seconds, again.seconds);
  }
  return result;
}

/// The study with those of these runs that are refused or have a result. `take` moves the result of a run of the plan;
/// absent: there is none.
StudyView view_of(const Experiment& experiment, const Options& options, const Plan& plan,
                  const std::filesystem::path& folder, const std::vector<std::size_t>& runs,
                  const std::function<std::optional<RunResult>(std::size_t run)>& take) {
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
  view.runs.reserve(runs.size());
  Variants variants(runs.size());
  for (const std::size_t i : runs) {
    std::optional<RunResult> result;
    if (!plan.rows[i].refused && !(result = take(i))) continue;
    PlannedRun run = plan.run(i, &variants);
    RunRecord record{std::move(run.id), std::move(run.config), {}, std::move(run.scenario)};
    if (result) {
      record.result = std::move(*result);
      if (!plan.rows[i].keeps_curves) drop_curves(record.result);
    } else {
      record.result.status = "refused";
      record.result.message = run.refusal;
    }
    view.runs.push_back(std::move(record));
  }
  return view;
}

std::vector<std::size_t> all_of(const Plan& plan) {
  std::vector<std::size_t> runs(plan.size());
  std::iota(runs.begin(), runs.end(), std::size_t{0});
  return runs;
}

/// True if the result has all that is kept of it. A run that took no step has no curves.
bool is_complete(const RunResult& result, const PlanRow& row) {
  return !row.keeps_curves || !result.series.empty() || result.steps == 0;
}

using UseResult = std::function<void(std::uint64_t id, RunResult&& result)>;

/// Calls use(id, result) for the valid results in the store of a folder. Throws std::runtime_error if it cannot be
/// read.
void for_each_result(const std::filesystem::path& folder, const UseResult& use) {
  if (Store::ids_in(folder).empty()) return;  // a shard that has just begun
  Store(folder, metric_table(), Access::read).for_each(Curves::with, [&](StoredRun&& stored) {
    if (stored.damage.empty()) use(number_of_id(stored.id), std::move(stored.result));
  });
}

/// The further runs that the experiment requests, given the results of the plan among these.
std::vector<RunConfig> further_runs(const Experiment& experiment, const Options& options, const Plan& plan,
                                    const std::filesystem::path& folder, ResultsById& results) {
  ResultsById used;  // results in the view, without the curves that the plan does not keep
  StudyView view = view_of(experiment, options, plan, folder, all_of(plan), [&](std::size_t i) {
    const auto found = results.find(plan.rows[i].id);
    if (found == results.end()) return std::optional<RunResult>();
    if (plan.rows[i].keeps_curves) return std::optional(std::move(found->second));
    RunResult& kept = used[plan.rows[i].id] = std::move(found->second);
    return std::optional(kept);
  });
  const std::vector<RunConfig> further = experiment.refine(view);
  for (RunRecord& run : view.runs) {
    const auto found = results.find(number_of_id(run.id));
    if (found != results.end()) found->second = std::move(run.result);
  }
  for (auto& [id, result] : used) results[id] = std::move(result);
  return further;
}

}  // namespace

StudyRuns::StudyRuns(const Experiment& experiment, const Options& options, Plan& plan, std::filesystem::path folder,
                     std::filesystem::path own)
    : experiment_(experiment),
      options_(options),
      plan_(plan),
      folder_(std::move(folder)),
      own_(std::move(own)),
      store_(own_),
      others_(shard_folders(folder_)) {
  store_.keep_scenarios(plan.scenarios);
  if (std::filesystem::exists(folder_ / Store::file_name)) others_.push_back(folder_);
  std::erase(others_, own_);
  look();
}

/// Finds out which runs of the plan are in a store.
void StudyRuns::look() {
  places_.assign(plan_.size(), Place::nowhere);
  const std::unordered_set<std::int64_t> configurations = store_.configuration_keys();
  std::vector<std::int64_t> damaged;  // numbers of runs
  std::string first;
  std::size_t stored = 0;
  store_.for_each(Curves::with, [&](StoredRun&& run) {
    ++stored;
    if (run.damage.empty() && !configurations.contains(run.configuration)) run.damage = "runs.configuration";
    if (!run.damage.empty()) {
      if (damaged.empty()) first = run.name() + ", " + run.damage;
      damaged.push_back(run.number);
    } else if (!options_.force || run.result.status != "failed") {
      const auto number = plan_.find(number_of_id(run.id));
      if (number && is_whole(*number, run.result)) places_[*number] = Place::own_store;
    }
  });
  if (!damaged.empty()) {
    fmt::print(stderr, "{}: {}: {} of {} runs are damaged and carried out again (the first: {})\n", experiment_.name,
               (own_ / Store::file_name).string(), damaged.size(), stored, first);
    store_.forget(damaged);
  }
  std::erase_if(others_, [&](const std::filesystem::path& other) {
    try {
      for_each_result(other, [&](std::uint64_t id, RunResult&& result) {
        const auto run = plan_.find(id);
        if (run && places_[*run] == Place::nowhere && is_whole(*run, result)) places_[*run] = Place::other_store;
      });
      return false;
    } catch (const std::runtime_error& error) {  // its shard is under way on a network file system
      fmt::print(stderr, "{}: left out: {}\n", experiment_.name, error.what());
      return true;
    }
  });
}

/// True if nothing that is kept of the run is missing.
bool StudyRuns::is_whole(std::size_t run, const RunResult& result) const {
  const PlanRow& row = plan_.rows[run];
  if (!is_complete(result, row)) return false;
  return options_.trajectory == TrajectoryFormat::none ||
         seems_whole(options_.trajectory, trajectory_folder(experiment_, folder_, id_of_number(row.id)));
}

std::size_t StudyRuns::count(Place place) const {
  return static_cast<std::size_t>(std::count(places_.begin(), places_.end(), place));
}

std::size_t StudyRuns::missing() const {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) missing += places_[i] == Place::nowhere && !plan_.rows[i].refused;
  return missing;
}

void StudyRuns::join() {
  constexpr std::size_t at_a_time = 1000;
  std::vector<RunRecord> records;
  const auto keep = [&] {
    store_.keep(records);
    records.clear();
  };
  for (const auto& other : others_) {
    for_each_result(other, [&](std::uint64_t id, RunResult&& result) {
      const auto i = plan_.find(id);
      if (!i || places_[*i] != Place::other_store || !is_complete(result, plan_.rows[*i])) return;
      PlannedRun run = plan_.run(*i);
      records.push_back({std::move(run.id), std::move(run.config), std::move(result)});
      places_[*i] = Place::own_store;
      if (records.size() == at_a_time) keep();
    });
  }
  keep();
}

bool StudyRuns::carry_out_missing(Interruption& interruption, const MakePart& make) {
  std::vector<std::uint32_t> runs;
  const auto shards = options_.shard ? deal(plan_, options_.shard->count) : std::vector<std::size_t>();
  std::size_t elsewhere = 0;  // missing runs of other shards
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    if (places_[i] != Place::nowhere || plan_.rows[i].refused) continue;
    if (options_.shard && shards[i] != options_.shard->number) ++elsewhere;
    else runs.push_back(static_cast<std::uint32_t>(i));
  }
  if (runs.empty()) return true;
  const std::size_t there = count(Place::own_store) + count(Place::other_store);
  if (there > 0 && !std::exchange(begun_, true)) {
    fmt::print(stderr, "{}: {} of {} runs are there already\n", experiment_.name,
               plan_.size() - runs.size() - elsewhere, plan_.size());
  }
  begun_ = true;
  run(runs, interruption, make);
  if (!interruption.no_more()) return true;
  fmt::print(stderr, "{}: interrupted; {} of {} runs are kept in {}; the same command goes on from there\n",
             experiment_.name, count(Place::own_store) + count(Place::other_store), plan_.size(), folder_.string());
  return false;
}

/// Carries out these runs, until no more may begin.
void StudyRuns::run(const std::vector<std::uint32_t>& runs, Interruption& interruption, const MakePart& make) {
  References references;
  std::optional<RunsInOrder> ordered;
  if (make && runs.size() == plan_.size()) ordered.emplace(runs.size(), make);
  std::vector<std::uint64_t> scenarios;
  scenarios.reserve(runs.size());
  for (const std::uint32_t i : runs) scenarios.push_back(plan_.rows[i].scenario);
  references.expect(std::move(scenarios));
  const auto trajectory = [&](const std::string& id) {
    if (options_.trajectory == TrajectoryFormat::none) return TrajectoryRequest{};
    return TrajectoryRequest{options_.trajectory, trajectory_folder(experiment_, folder_, id)};
  };
  Work work{
      .key = [&](const PlannedRun& run) { return ensemble_key(run.config, *run.scenario, trajectory(run.id)); },
      .carry_out =
          [&](Batch batch, std::atomic<double>& share, const Finished& finished) {
            if (batch.size() == 1) {
              finished(0, carry_out_alone(experiment_, batch.front(), trajectory(batch.front().id), references,
                                          interruption, share));
              return;
            }
            std::vector<LanedRun> lanes;
            for (const PlannedRun& run : batch) lanes.push_back({run.config, *run.scenario, run.keeps_curves});
            carry_out_together({lanes, finished, &interruption.stop(), &interruption.no_more(), &references, &share});
          },
      .finish =
          [&](const std::vector<RunRecord>& records) {
            if (options_.trajectory == TrajectoryFormat::none) return;
            std::vector<std::filesystem::path> folders;
            for (const RunRecord& record : records) folders.push_back(trajectory(record.id).folder);
            finish_trajectories(options_.trajectory, folders);
          }};
  if (ordered) {
    work.stored = [&](std::span<const std::uint32_t> numbers, std::span<RunRecord> records) {
      ordered->add(numbers, records);
    };
    work.between = [&] { ordered->work(); };
  }
  const std::string name =
      options_.shard ? fmt::format("{} {}/{}", experiment_.name, options_.shard->number, options_.shard->count)
                     : experiment_.name;
  for (const std::uint32_t i : run_all(name, plan_, runs, work, options_.jobs, store_, interruption.no_more()))
    places_[i] = Place::own_store;
  if (ordered) used_parts_ = ordered->used();
}

bool StudyRuns::widen() {
  if (!experiment_.refine) return false;
  hold_results();
  if (study::widen(plan_, further_runs(experiment_, options_, plan_, folder_, held_)) == 0) return false;
  choose_curves(options_, plan_);
  places_.assign(plan_.size(), Place::nowhere);
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const std::uint64_t id = plan_.rows[i].id;
    const auto found = held_.find(id);
    if (found != held_.end() && is_whole(i, found->second))
      places_[i] = elsewhere_.contains(id) ? Place::other_store : Place::own_store;
  }
  return true;
}

/// Reads the results that are not held yet: those of the plan, and in a study that is refined all others, which it may
/// come to have.
void StudyRuns::hold_results() {
  if (held_.empty()) {
    const auto is_wanted = [&](std::uint64_t id) { return experiment_.refine || plan_.contains(id); };
    store_.for_each(Curves::with, [&](StoredRun&& run) {
      const std::uint64_t id = number_of_id(run.id);
      if (run.damage.empty() && is_wanted(id)) held_[id] = std::move(run.result);
    });
    for (const auto& other : others_) {
      for_each_result(other, [&](std::uint64_t id, RunResult&& result) {
        if (is_wanted(id) && held_.try_emplace(id, std::move(result)).second) elsewhere_.insert(id);
      });
    }
    return;
  }
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const std::uint64_t id = plan_.rows[i].id;
    if (places_[i] != Place::own_store || (held_.contains(id) && !elsewhere_.contains(id))) continue;
    held_[id] = result(i, Curves::with);
    elsewhere_.erase(id);
  }
}

StudyView StudyRuns::view() {
  if (held_.empty()) hold_results();
  ResultsById results = std::exchange(held_, {});
  return view_of(experiment_, options_, plan_, folder_, all_of(plan_), [&](std::size_t i) {
    const auto found = results.find(plan_.rows[i].id);
    return found == results.end() ? std::nullopt : std::optional(std::move(found->second));
  });
}

StudyView StudyRuns::view(const std::vector<std::size_t>& runs) const {
  return view_of(experiment_, options_, plan_, folder_, runs,
                 [&](std::size_t i) { return std::optional(result(i, Curves::with)); });
}

StudyView StudyRuns::planned(const std::vector<std::size_t>& runs) const {
  return view_of(experiment_, options_, plan_, folder_, runs, [](std::size_t) { return std::optional<RunResult>({}); });
}

void StudyRuns::for_each_part(const MakePart& make) const {
  std::mutex reading;
  const std::size_t parts = (plan_.size() + runs_of_a_part - 1) / runs_of_a_part;
  in_order(parts - used_parts_, number_of_threads(options_.jobs), [&](std::size_t part) {
    std::vector<RunRecord> records;
    Variants variants;
    LastOptions last;
    const std::size_t first = (used_parts_ + part) * runs_of_a_part;
    const std::size_t end = std::min(first + runs_of_a_part, plan_.size());
    records.reserve(end - first);
    for (std::size_t i = first; i < end; ++i) {
      RunRecord& record = records.emplace_back();
      record.id = id_of_number(plan_.rows[i].id);
      if (plan_.rows[i].refused) {
        PlannedRun run = plan_.run(i, &variants);
        record.config = std::move(run.config);
        record.result.status = "refused";
        record.result.message = std::move(run.refusal);
      } else {
        record.config = plan_.config(i, &last);
      }
    }
    {
      const std::lock_guard lock(reading);
      Store::Reading stored(store_);
      for (std::size_t i = first; i < end; ++i) {
        if (!plan_.rows[i].refused) check_found(i, stored.find(plan_.rows[i].id, records[i - first].result));
      }
    }
    return make(std::move(records));
  });
}

RunResult StudyRuns::result(std::size_t run, Curves curves) const {
  std::optional<StoredRun> stored = store_.find(id_of_number(plan_.rows[run].id), curves);
  check_found(run, stored ? std::optional(stored->damage) : std::nullopt);
  return std::move(stored->result);
}

/// Throws std::runtime_error if a run is damaged in the own store, or is not there.
void StudyRuns::check_found(std::size_t run, const std::optional<std::string>& damage) const {
  if (damage && damage->empty()) return;
  throw std::runtime_error(fmt::format("{}: run {} cannot be read back ({})", (own_ / Store::file_name).string(),
                                       id_of_number(plan_.rows[run].id), damage ? *damage : "it is gone"));
}

void choose_curves(const Options& options, Plan& plan) {
  std::vector<std::uint64_t> motions;
  motions.reserve(plan.size());
  for (PlanRow& row : plan.rows) {
    row.keeps_curves = false;
    motions.push_back(row.scenario);
  }
  for (const std::size_t i : shown_runs(motions, options.curves.value_or(motions.size())))
    plan.rows[i].keeps_curves = true;
}

BelongsToStudy runs_of_study(const Experiment& experiment, const Options& options, const Plan& given,
                             const std::filesystem::path& folder) {
  if (!experiment.refine) return [&given](std::uint64_t id) { return given.contains(id); };
  const auto whole = std::make_shared<Plan>(given);
  Plan& plan = *whole;
  std::vector<std::filesystem::path> stores = shard_folders(folder);
  stores.push_back(folder);
  ResultsById results;
  for (const auto& store : stores) {
    try {
      for_each_result(store, [&](std::uint64_t id, RunResult&& result) { results.emplace(id, std::move(result)); });
    } catch (const std::runtime_error&) {  // ResultFolder reports the error
    }
  }
  while (widen(plan, further_runs(experiment, options, plan, folder, results)) > 0) choose_curves(options, plan);
  return [whole](std::uint64_t id) { return whole->contains(id); };
}

}  // namespace polhode::study::workers
