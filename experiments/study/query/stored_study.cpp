// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/stored_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "experiments/study/plan/run_order.hpp"
#include "experiments/study/query/selection.hpp"
#include "experiments/study/query/stored_run.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline query {
namespace {

/// Ids of the runs that satisfy the conditions.
std::set<std::uint64_t> chosen(const ResultStores& stores, const std::vector<std::string>& where) {
  const RunColumns columns(stores);
  std::vector<Where> conditions;
  for (const std::string& text : where) conditions.emplace_back(text, "--where");
  std::set<std::uint64_t> ids;
  for (const Hit& hit : select(stores, columns, conditions, {}, Order::stored).hits)
    ids.insert(static_cast<std::uint64_t>(hit.id));
  if (ids.size() > most_table_rows)
    throw InputError(fmt::format("{} are more than a figure is made of ({}); choose some with --where",
                                 count(ids.size(), "run"), most_table_rows));
  return ids;
}

/// Runs of different studies vary different keys: each gets all of them, with an empty value for those that it leaves
/// unchanged.
void vary_the_same_keys(std::vector<RunRecord>& runs) {
  std::vector<std::string> keys;
  for (const RunRecord& run : runs) {
    for (const Override& varied : run.config.varied) {
      if (std::find(keys.begin(), keys.end(), varied.key) == keys.end()) keys.push_back(varied.key);
    }
  }
  for (RunRecord& run : runs) {
    std::vector<Override>& varied = run.config.varied;
    if (varied.size() == keys.size()) continue;
    std::vector<Override> all;
    for (const std::string& key : keys) {
      const auto found = std::find_if(varied.begin(), varied.end(), [&](const auto& v) { return v.key == key; });
      all.push_back(found == varied.end() ? Override{key, ""} : *found);
    }
    varied = std::move(all);
  }
}

std::vector<RunRecord> sorted(std::vector<RunRecord> runs) {
  vary_the_same_keys(runs);
  RunOrder order(runs.size());
  for (const RunRecord& run : runs) order.add(sort_key(run.config));
  std::vector<RunRecord> ordered;
  for (const std::uint32_t i : order.sorted([&](auto a, auto b) { return runs[a].id < runs[b].id; }))
    ordered.push_back(std::move(runs[i]));
  return ordered;
}

/// True if the durations of the runs go with their steps. In a study that varies the duration, each step has them all,
/// two or more.
bool durations_follow_steps(const std::vector<RunRecord>& runs) {
  std::set<std::pair<std::string, double>> steps;
  std::set<std::tuple<std::string, double, double>> with_duration;
  for (const RunRecord& run : runs) {
    const double step = run.config.tolerance ? -*run.config.tolerance : run.config.dt.value_or(0);
    steps.emplace(run.config.scenario, step);
    with_duration.emplace(run.config.scenario, step, run.config.t_end);
  }
  return with_duration.size() < 2 * steps.size();
}

}  // namespace

StoredStudyView stored_study(const ResultStores& stores, const std::vector<std::string>& where) {
  StoredStudyView stored;
  StudyView& view = stored.view;
  const std::set<std::uint64_t> ids = chosen(stores, where);
  std::set<std::string> invariants, seen, scenarios, unreadable;
  std::string first;
  for (const auto& open : stores.all()) {
    for (const StoredStudy& study : open->store.studies())
      view.experiment = study.experiment, view.command = study.command;
    invariants.merge(invariants_of(*open));
    open->store.for_each(Curves::with, [&](StoredRun&& run) {
      const bool damaged = !run.damage.empty() || !open->configurations.contains(run.configuration);
      if (seen.contains(run.id) || (!damaged && !ids.contains(number_of_id(run.id)))) return;
      try {
        ReadRun read = read_run(run, open->configurations, open->scenarios);
        seen.insert(run.id);
        if (scenarios.insert(read.config.scenario).second)
          view.scenarios.push_back(source_of(open->scenarios, read.config.scenario).resolve());
        view.runs.push_back({run.id, std::move(read.config), std::move(run.result), std::move(read.scenario)});
      } catch (const std::runtime_error& reason) {
        if (unreadable.empty()) first = fmt::format("{} of {}: {}", run.name(), open->file.string(), reason.what());
        unreadable.insert(run.id);
      }
    });
  }
  for (const std::string& id : seen) unreadable.erase(id);
  if (!unreadable.empty())
    stored.remarks.push_back(fmt::format("{} left out, which cannot be read; the first: {}",
                                         count(unreadable.size(), "run"), one_line(first)));
  if (view.runs.empty()) {
    std::string why = where.empty() ? "there is no run to draw in " + words(first_items(stores.folders(), 4))
                                    : "--where: no run satisfies the conditions";
    for (const std::string& remark : stored.remarks) why += "; " + remark;
    throw InputError(why);
  }
  view.runs = sorted(std::move(view.runs));
  view.durations_follow_steps = stores.all().size() == 1 && durations_follow_steps(view.runs);
  view.invariants.assign(invariants.begin(), invariants.end());
  return stored;
}

}  // namespace polhode::study::query
