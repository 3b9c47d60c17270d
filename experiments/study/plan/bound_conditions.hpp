// SPDX-License-Identifier: BSD-3-Clause
// The conditions of a study, with their keys found in one scenario.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/plan/cells.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline plan {

class BoundConditions {
 public:
  /// `varied`: the keys of the scenario that the study varies, sorted. The conditions must outlive this object.
  BoundConditions(std::span<const Where> conditions, const ScenarioSource& source,
                  const std::vector<std::string>& varied);

  /// Throws InputError if a key of the condition is neither an option nor a key of any of the scenarios.
  static void check_keys(const Where& condition, std::span<const ScenarioSource* const> sources);

  /// True if all conditions hold. `config`: the configuration of the cell.
  bool hold(const Cell& cell, const RunConfig& config) const;

 private:
  /// Where the value of a key comes from: an option, the last of the varied keys that sets it, or the scenario.
  struct Source {
    const RunOption* option = nullptr;
    struct Setter {
      std::string key;                ///< as the study names it
      std::vector<std::string> rest;  ///< the way from its value to that of the key: {"1"} from inertia to inertia.1
    };
    std::vector<Setter> setters;
    WhereValue otherwise{};  ///< as the scenario has it
  };
  static std::optional<WhereValue> set_by(const Source& source, const Cell& cell);

  std::span<const Where> conditions_;
  std::vector<std::vector<Source>> sources_;  // by condition and key
};

}  // namespace polhode::study::plan
