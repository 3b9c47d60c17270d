// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/named_options.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline query {
namespace {

void add_named(const std::string& manifest, NamedOptions& named) {
  using Json = nlohmann::json;
  const Json said = Json::parse(manifest, nullptr, false);
  if (!said.is_object() || !said.contains("named") || !said["named"].is_array()) return;
  for (const Json& option : said["named"]) {
    if (option.is_string()) named.insert(option.get<std::string>());
  }
}

}  // namespace

NamedOptions named_options(const ResultStores& stores, std::span<const Configuration* const> configurations) {
  NamedOptions named;
  for (const auto& open : stores.all()) {
    for (const StoredStudy& study : open->store.studies()) add_named(study.manifest, named);
  }
  for (const RunOption& option : run_options()) {
    const auto unusual = [&](const Configuration* configuration) {
      const auto found = configuration->find(option.column);
      return found != configuration->end() && found->second != option.usual;
    };
    if (option.on_demand && std::any_of(configurations.begin(), configurations.end(), unusual))
      named.insert(option.name);
  }
  return named;
}

}  // namespace polhode::study::query
