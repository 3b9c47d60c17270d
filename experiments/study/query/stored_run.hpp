// SPDX-License-Identifier: BSD-3-Clause
// A run from what its store says of it: its configuration and its scenario, from which it can be carried out again.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/study/record/run_record.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/store/store.hpp"

namespace polhode::study::inline query {

/// The data of a run in a store do not make a run here. what() is one line without the name of the store.
struct NotReproduced : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The varied keys of a text of `runs.varied` (varied_text()), in their order.
std::vector<Override> varied_of(const std::string& text);

/// The configuration. Throws NotReproduced for an option, or a value of one, that this program does not have.
RunConfig config_of(const Configuration& configuration, const std::string& varied);

/// A scenario of a store. Throws NotReproduced if it is not there, or not in words, and InputError as
/// ScenarioSource::parse() does.
ScenarioSource source_of(const std::map<std::string, StoredScenario>& scenarios, const std::string& name);

/// A run that can be carried out.
struct ReadRun {
  RunConfig config;
  std::shared_ptr<const Scenario> scenario;  ///< scenario with the varied keys set
  std::optional<int> version;                ///< results version with which the id is that of the store; absent: none
};

/// The run, from its row in the store and what the row refers to. Throws NotReproduced if one of these is damaged or
/// unknown here, and InputError if the scenario cannot be read.
ReadRun read_run(const StoredRun& run, const std::map<std::int64_t, Configuration>& configurations,
                 const std::map<std::string, StoredScenario>& scenarios);

}  // namespace polhode::study::query
