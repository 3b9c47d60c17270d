// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/summary.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

#include "experiments/results/listing.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/store/run_rows.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::results {
namespace {

constexpr std::size_t most_names = 12;

/// The content of a folder.
struct Content {
  std::set<std::string> studies;
  std::map<std::string, std::int64_t> scenarios, methods, statuses;  ///< number of runs
  std::unordered_set<std::int64_t> sound, damaged;                   ///< ids, of a folder with several stores
  std::int64_t runs = 0, damaged_runs = 0;
  std::string first_damaged;
};

void read(const OpenStore& open, bool several, Content& content) {
  for (const StoredStudy& study : open.store.studies()) content.studies.insert(study.experiment + ": " + study.command);
  const RunRows rows(open.store);
  const std::size_t status = *rows.find("status"), configuration = *rows.find(configuration_column);
  std::map<std::int64_t, std::int64_t> by_configuration;
  rows.for_each([&](const RunRows::Row& row) {
    const auto* key = std::get_if<std::int64_t>(&row.values[configuration]);
    const bool sound = row.damage.empty() && key && open.configurations.contains(*key);
    if (several && content.sound.contains(row.id)) return;
    if (!sound) {
      if (!several || content.damaged.insert(row.id).second) ++content.damaged_runs;
      if (content.first_damaged.empty()) {
        content.first_damaged = fmt::format("run {} of {}: {}", id_of_number(static_cast<std::uint64_t>(row.id)),
                                            open.file.string(), row.damage.empty() ? "runs.configuration" : row.damage);
      }
      return;
    }
    if (several) {
      content.sound.insert(row.id);
      if (content.damaged.erase(row.id) > 0) --content.damaged_runs;
    }
    ++content.runs;
    ++by_configuration[*key];
    ++content.statuses[std::string(std::get<std::string_view>(row.values[status]))];
  });
  for (const auto& [key, runs] : by_configuration) {
    const Configuration& options = open.configurations.at(key);
    const auto name = [&](const char* option) {
      const auto found = options.find(option);
      return found == options.end() ? std::string("-") : text_of(found->second);
    };
    content.scenarios[name("scenario")] += runs;
    content.methods[name("integrator")] += runs;
  }
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
    fmt::print("{}: {}{}\n", folder, count(static_cast<std::size_t>(content.runs), "run"),
               stores_of[folder] > 1 ? fmt::format(" in {} stores", stores_of[folder]) : "");
    if (content.studies.empty()) fmt::print("  no study has ended here yet\n");
    for (const std::string& study : content.studies) fmt::print("  {}\n", study);
    if (content.runs > 0) {
      fmt::print("  scenarios: {}\n  methods: {}\n  status: {}\n", names_and_counts(content.scenarios),
                 names_and_counts(content.methods), names_and_counts(content.statuses));
    }
    if (content.damaged_runs > 0) {
      fmt::print("  damaged: {} (the first: {}); the command of the study carries them out again\n",
                 count(static_cast<std::size_t>(content.damaged_runs), "run"), content.first_damaged);
      status = damaged_runs;
    }
  }
  return status;
}

}  // namespace polhode::study::results
