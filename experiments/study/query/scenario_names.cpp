// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/scenario_names.hpp"

#include <set>
#include <stdexcept>

#include "experiments/study/query/stored_run.hpp"

namespace polhode::study::inline query {
namespace {

/// The canonical text as this program writes it: stores of another version may have written the same scenario
/// otherwise.
std::string canonical_of(const OpenStore& store, const std::string& name) {
  try {
    return source_of(store.scenarios, name).resolve().canonical();
  } catch (const std::runtime_error&) {
    return store.scenarios.at(name).canonical;
  }
}

}  // namespace

ScenarioNames::ScenarioNames(const ResultStores& stores) {
  std::map<std::string, std::set<std::string>> stored;  // canonical texts by name
  for (const auto& open : stores.all()) {
    for (const auto& [name, scenario] : open->scenarios) stored[name].insert(scenario.canonical);
  }
  for (const auto& [name, texts] : stored) {
    if (texts.size() == 1) continue;
    std::map<std::string, std::string> folders;  // the first folder that has a text
    std::map<std::pair<const OpenStore*, std::string>, std::string> names;
    for (const auto& open : stores.all()) {
      if (!open->scenarios.contains(name)) continue;
      const auto first = folders.try_emplace(canonical_of(*open, name), open->folder.string()).first;
      names[{open.get(), name}] = name + " (" + first->second + ")";
    }
    if (folders.size() > 1) names_.merge(names);
  }
}

std::string ScenarioNames::of(const std::string& name, const OpenStore& store) const {
  const auto found = names_.find({&store, name});
  return found == names_.end() ? name : found->second;
}

}  // namespace polhode::study::query
