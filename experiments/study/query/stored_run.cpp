// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/stored_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <variant>

#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline query {
namespace {

/// True if the value has the type of the option's values.
bool fits(const RunOption& option, const OptionValue& value) {
  switch (option.kind) {
    case RunOption::Kind::whole:
    case RunOption::Kind::flag: return std::holds_alternative<std::int64_t>(value);
    case RunOption::Kind::number: return std::holds_alternative<double>(value);
    default: return std::holds_alternative<std::string>(value);
  }
}

}  // namespace

std::vector<Override> varied_of(const std::string& text) {
  std::vector<Override> varied;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size()), equals = text.find('=', at);
    if (equals >= end) throw NotReproduced("its varied keys are not of the form key=value");
    Override one{.key = text.substr(at, equals - at), .value = ""};
    for (std::size_t k = equals + 1; k < end; ++k) {
      const bool escaped = text[k] == '\\' && k + 1 < end;
      if (escaped) ++k;
      one.value += escaped && text[k] == 'n' ? '\n' : text[k];
    }
    varied.push_back(std::move(one));
    at = end + 1;
  }
  return varied;
}

RunConfig config_of(const Configuration& configuration, const std::string& varied) {
  RunConfig config;
  std::set<std::string> unknown;
  for (const auto& [name, value] : configuration) unknown.insert(name);
  for (const RunOption& option : run_options()) {
    const std::string name = option.column.empty() ? file_key(option) : option.column;
    const auto found = configuration.find(name);
    if (found == configuration.end()) continue;
    unknown.erase(name);
    if (fits(option, found->second)) option.set(config, found->second);
    if (option.value(config) != found->second)
      throw NotReproduced(fmt::format("its {} is {}, which this program does not know", name, text_of(found->second)));
  }
  if (!unknown.empty()) throw NotReproduced("it has the option " + *unknown.begin() + ", which this program has not");
  config.varied = varied_of(varied);
  return config;
}

ScenarioSource source_of(const std::map<std::string, StoredScenario>& scenarios, const std::string& name) {
  const auto found = scenarios.find(name);
  if (found == scenarios.end())
    throw NotReproduced("the store does not have its scenario " + name + ", or it is damaged");
  if (found->second.source.empty()) throw NotReproduced("the store does not have the text of its scenario " + name);
  return ScenarioSource::parse(found->second.source, name + ".toml");
}

ReadRun read_run(const StoredRun& run, const std::map<std::int64_t, Configuration>& configurations,
                 const std::map<std::string, StoredScenario>& scenarios) {
  if (!run.damage.empty()) throw NotReproduced("it is damaged (" + run.damage + ")");
  const auto configuration = configurations.find(run.configuration);
  if (configuration == configurations.end()) throw NotReproduced("it is damaged (its configuration)");
  ReadRun read;
  read.config = config_of(configuration->second, run.varied);
  const ScenarioSource source = source_of(scenarios, read.config.scenario);
  read.scenario = std::make_shared<const Scenario>(source.resolve(read.config.varied));
  for (int version = results_version; version > 0 && !read.version; --version) {
    if (run_id(read.config, read.scenario->canonical(), version) == run.id) read.version = version;
  }
  return read;
}

}  // namespace polhode::study::query
