// SPDX-License-Identifier: BSD-3-Clause
// The id of a run: a hash of all that decides its results. As a number for lists of many runs, as text elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/record/versions.hpp"

namespace polhode::study::inline record {

/// The ids of runs whose configurations differ in the varied keys alone.
class RunNumbers {
 public:
  explicit RunNumbers(const RunConfig& config, int version = results_version);

  /// As run_number() of the configuration with these varied keys.
  std::uint64_t of(const std::vector<Override>& varied, std::string_view canonical) const;

 private:
  std::string version_;
  IdentityText text_;
};

/// `canonical`: Scenario::canonical() with the varied keys set. Varied keys with an empty value, which the run leaves
/// unchanged, are no part of the id.
std::uint64_t run_number(const RunConfig& config, std::string_view canonical, int version = results_version);
/// The same as 16 hexadecimal digits.
std::string run_id(const RunConfig& config, std::string_view canonical, int version = results_version);

/// The parts of the id besides the version and the text of the scenario: options by the names of their columns (or as
/// files name them), and the varied keys. The parts of two configurations that vary the same keys are the same if and
/// only if identity_of() is.
std::vector<std::pair<std::string, std::string>> identity_parts(const RunConfig& config);

/// The id as an integer, and back: 16 hexadecimal digits. Throws std::logic_error for a text that is no id.
std::uint64_t number_of_id(const std::string& id);
std::string id_of_number(std::uint64_t number);

}  // namespace polhode::study::record
