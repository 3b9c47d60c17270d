// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "experiments/results/listing.hpp"
#include "experiments/study/query/row_parts.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/store/run_rows.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::results {
namespace {

constexpr std::size_t most_names = 12;

/// Ids met in the stores of a folder that has several.
struct Met {
  std::unordered_set<std::int64_t> sound, damaged;
};

/// Numbers of runs in some rows.
struct Counts {
  std::map<std::int64_t, std::int64_t> by_configuration;
  std::map<std::string, std::int64_t> statuses;
  std::int64_t runs = 0, damaged_runs = 0;
  std::string first_damaged;

  void add(const Counts& more) {
    for (const auto& [key, count] : more.by_configuration) by_configuration[key] += count;
    for (const auto& [status, count] : more.statuses) statuses[status] += count;
    runs += more.runs;
    damaged_runs += more.damaged_runs;
    if (first_damaged.empty()) first_damaged = more.first_damaged;
  }
};

/// The content of a folder.
struct Content {
  std::set<std::string> studies;
  std::map<std::string, std::int64_t> scenarios, methods;  ///< number of runs
  Counts counts;
  Met met;
};

/// Counts the rows of a store, one at a call.
class RowCounter {
 public:
  /// `met`: null for a folder with one store.
  RowCounter(const OpenStore& open, const RunRows& rows, Met* met, Counts& counts)
      : open_(open),
        met_(met),
        counts_(counts),
        status_(*rows.find("status")),
        configuration_(*rows.find(configuration_column)) {}

  void operator()(const RunRows::Row& row) const {
    const auto* key = std::get_if<std::int64_t>(&row.values[configuration_]);
    if (met_ && met_->sound.contains(row.run.id)) return;
    if (!row.damage.empty() || !key || !open_.configurations.contains(*key)) {
      if (!met_ || met_->damaged.insert(row.run.id).second) ++counts_.damaged_runs;
      if (counts_.first_damaged.empty()) {
        counts_.first_damaged = fmt::format("{} of {}: {}", row.run.name(), open_.file.string(),
                                            row.damage.empty() ? "runs.configuration" : row.damage);
      }
      return;
    }
    if (met_) {
      met_->sound.insert(row.run.id);
      if (met_->damaged.erase(row.run.id) > 0) --counts_.damaged_runs;
    }
    ++counts_.runs;
    ++counts_.by_configuration[*key];
    ++counts_.statuses[std::string(std::get<std::string_view>(row.values[status_]))];
  }

 private:
  const OpenStore& open_;
  Met* met_;
  Counts& counts_;
  std::size_t status_, configuration_;
};

/// Counts the rows of a folder with one store.
Counts count_in_parts(const OpenStore& open) {
  Counts all;
  for_each_part(open, [&](const RowPart& part) -> UsePart {
    Counts counts;
    part.rows.for_each(part.after, part.last, RowCounter(open, part.rows, nullptr, counts));
    return [&all, counts = std::move(counts)] { all.add(counts); };
  });
  return all;
}

void read(const OpenStore& open, bool several, Content& content) {
  for (const StoredStudy& study : open.store.studies()) content.studies.insert(study.experiment + ": " + study.command);
  Counts counts;
  if (several) {
    const RunRows rows(open.store);
    rows.for_each(RowCounter(open, rows, &content.met, counts));
  } else {
    counts = count_in_parts(open);
  }
  for (const auto& [key, runs] : counts.by_configuration) {
    const Configuration& options = open.configurations.at(key);
    const auto name = [&](const char* option) {
      const auto found = options.find(option);
      return found == options.end() ? std::string("-") : text_of(found->second);
    };
    content.scenarios[name("scenario")] += runs;
    content.methods[name("integrator")] += runs;
  }
  content.counts.add(counts);
}

std::string names_and_counts(const std::map<std::string, std::int64_t>& counts) {
  std::vector<std::string> items;
  for (const auto& [name, runs] : counts) items.push_back(fmt::format("{} ({})", name, runs));
  return fmt::format("{}", fmt::join(first_items(std::move(items), most_names), ", "));
}

}  // namespace

int summarise(const ResultStores& stores) {
  int status = 0;
  std::map<std::string, std::size_t> stores_of;
  for (const auto& open : stores.all()) ++stores_of[open->folder.string()];
  for (const std::string& folder : stores.folders()) {
    Content content;
    for (const auto& open : stores.all()) {
      if (open->folder.string() == folder) read(*open, stores_of[folder] > 1, content);
    }
    fmt::print("{}: {}{}\n", folder, count(static_cast<std::size_t>(content.counts.runs), "run"),
               stores_of[folder] > 1 ? fmt::format(" in {} stores", stores_of[folder]) : "");
    if (content.studies.empty()) fmt::print("  no study has ended here yet\n");
    for (const std::string& study : content.studies) fmt::print("  {}\n", study);
    if (content.counts.runs > 0) {
      fmt::print("  scenarios: {}\n  methods: {}\n  status: {}\n", names_and_counts(content.scenarios),
                 names_and_counts(content.methods), names_and_counts(content.counts.statuses));
    }
    if (content.counts.damaged_runs > 0) {
      fmt::print("  damaged: {} (the first: {}); the command of the study carries them out again\n",
                 count(static_cast<std::size_t>(content.counts.damaged_runs), "run"), content.counts.first_damaged);
      status = damaged_runs;
    }
  }
  return status;
}

}  // namespace polhode::study::results
