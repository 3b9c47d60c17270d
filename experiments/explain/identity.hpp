// SPDX-License-Identifier: BSD-3-Clause
// The parts that decide the id of a stored run, key by key.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/stored_run.hpp"

namespace polhode::study::explain {

/// A run with the text of its scenario.
struct ExplainedRun {
  std::string id;
  ReadRun read;
  std::string source;  ///< TOML text of the scenario, without varied keys
};

/// Throws std::runtime_error, with the run and the reason in one line, if the run is damaged or unknown here.
ExplainedRun explained(const FoundRun& found);

/// The keys of the identity and their values: the results version, a hash of the scenario's text, each option that
/// applies, each varied key.
std::vector<std::pair<std::string, std::string>> identity_of_run(const ExplainedRun& run);

struct KeyDifference {
  std::string key;
  std::string first, second;  ///< values of the key; empty: the run does not have it
};

/// The keys in which two runs differ. Keys of the scenario are those of its TOML text with the varied keys set,
/// defaults filled in; keys that decide nothing are left out. Empty: it is the same run.
std::vector<KeyDifference> differing_keys(const ExplainedRun& a, const ExplainedRun& b);

}  // namespace polhode::study::explain
