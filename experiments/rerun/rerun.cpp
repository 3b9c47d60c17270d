// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/rerun/rerun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/query/stored_run.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/versions.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/in_order.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::rerun {
namespace {

/// Runs that are read, carried out and compared before the next ones are read; they share references.
constexpr std::size_t at_a_time = 256;

struct Task {
  Repeated repeated;
  ReadRun run;
  RunResult stored, again;
};

std::string words_of_run(const RunConfig& config) {
  std::string text = config.scenario + ", " + config.integrator;
  if (config.dt) text += fmt::format(", dt {} s", *config.dt);
  if (config.tolerance) text += fmt::format(", tolerance {}", *config.tolerance);
  return text;
}

/// The reason why the run cannot be compared although it could be read; empty: it can.
std::string other_identity(const ReadRun& run) {
  if (run.version == results_version) return "";
  if (run.version) {
    return fmt::format(
        "it has results version {}, and this program makes version {}, with other digits; use the "
        "version of polhode that made it",
        *run.version, results_version);
  }
  return "its id is not that of what the store says of it; a later version of polhode may have made it";
}

Task read_task(const FoundRun& found) {
  Task task;
  task.repeated.run = found;
  try {
    std::optional<StoredRun> stored = found.where->store.find(found.id, Curves::with);
    if (!stored) throw NotReproduced("it was removed meanwhile");
    task.run = read_run(*stored, found.where->configurations, found.where->scenarios);
    task.stored = std::move(stored->result);
    task.repeated.words = words_of_run(task.run.config);
    task.repeated.why_not = other_identity(task.run);
  } catch (const NotReproduced& reason) {
    task.repeated.why_not = reason.what();
  } catch (const InputError& reason) {
    task.repeated.why_not = reason.what();
  }
  return task;
}

}  // namespace

void repeat(const std::vector<FoundRun>& runs, int jobs, const std::atomic<bool>& no_more,
            const std::atomic<bool>& stop, const std::function<void(const Repeated&)>& done) {
  const std::size_t threads = number_of_threads(jobs);
  for (std::size_t first = 0; first < runs.size() && !no_more; first += at_a_time) {
    std::vector<Task> tasks;
    std::vector<std::uint64_t> scenarios;
    for (std::size_t k = first; k < std::min(first + at_a_time, runs.size()); ++k) {
      tasks.push_back(read_task(runs[k]));
      if (tasks.back().repeated.why_not.empty()) scenarios.push_back(number_of(*tasks.back().run.scenario));
    }
    References references;
    references.expect(std::move(scenarios));
    const auto repeat_one = [&](std::size_t k) -> UsePart {
      Task& task = tasks[k];
      if (task.repeated.why_not.empty() && !no_more) {
        task.again = carry_out(task.run.config, *task.run.scenario, {}, &stop, &references);
        task.repeated.differences = differences(task.stored, task.again);
      }
      return [&task, &done] {
        const bool carried_out = !task.again.status.empty() && task.again.status != "interrupted";
        if (carried_out || !task.repeated.why_not.empty()) done(task.repeated);
      };
    };
    in_order(tasks.size(), threads, repeat_one, at_a_time);
  }
}

std::vector<FoundRun> all_runs(const ResultStores& stores) {
  std::map<std::string, std::vector<FoundRun>> found;  // runs by id
  for (const auto& open : stores.all()) {
    for (const std::uint64_t id : open->store.ids()) {
      const std::string text = id_of_number(id);
      found[text].push_back({open.get(), text});
    }
  }
  std::vector<FoundRun> runs;
  for (const auto& [id, places] : found) {
    FoundRun chosen = places.front();
    for (const FoundRun& place : places) {  // the first in which it is not damaged
      if (places.size() == 1) break;
      const auto stored = place.where->store.find(id, Curves::without);
      if (!stored || !stored->damage.empty()) continue;
      chosen = place;
      break;
    }
    runs.push_back(chosen);
  }
  return runs;
}

std::vector<FoundRun> drawn(std::vector<FoundRun> runs, std::size_t number, std::uint64_t seed) {
  if (number >= runs.size()) return runs;
  std::mt19937_64 random(seed);
  for (std::size_t k = 0; k < number; ++k) {
    const std::size_t left = runs.size() - k;
    std::swap(runs[k], runs[k + static_cast<std::size_t>(random() % left)]);
  }
  runs.resize(number);
  std::sort(runs.begin(), runs.end(), [](const FoundRun& a, const FoundRun& b) { return a.id < b.id; });
  return runs;
}

}  // namespace polhode::study::rerun
