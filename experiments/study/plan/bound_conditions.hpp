// SPDX-License-Identifier: BSD-3-Clause
// The conditions of a study, with their keys found in one scenario.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "experiments/study/plan/cells.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline plan {

/// A WhereValue that holds its text.
using HeldValue = std::variant<std::monostate, double, std::string>;

class BoundConditions {
 public:
  /// `varied`: the keys of the scenario that the study varies, sorted. The conditions must outlive this object.
  BoundConditions(std::span<const Where> conditions, const ScenarioSource& source,
                  const std::vector<std::string>& varied);

  /// Throws InputError if a key of the condition is neither an option nor a key of any of the scenarios.
  static void check_keys(const Where& condition, std::span<const ScenarioSource* const> sources);

  /// The value that an option has in a run of a cell that does not give it.
  using Default = std::function<OptionValue(const RunOption&, const Cell&)>;

  /// True if all conditions hold in a cell of the scenario. The cell is not made: conditions read the values of its
  /// keys. All calls must be with the same cells, and with the same defaults for cells of one block.
  bool hold(const Cells& cells, const Cells::Place& place, const Default& otherwise);

 private:
  /// A key of the conditions, as it is found in the scenario.
  struct Key {
    const RunOption* option = nullptr;
    /// The varied keys that set it, the last of which counts.
    struct Setter {
      std::string key;                ///< key as it is written in the study
      std::vector<std::string> rest;  ///< the way from its value to that of the key: {"1"} from inertia to inertia.1
    };
    std::vector<Setter> setters;
    HeldValue otherwise{};  ///< value in the scenario
  };
  /// A place in a cell that may give a key its value.
  struct Giver {
    std::size_t dimension = 0, key = 0;
    std::vector<std::string> rest;
    // The last text that had to be read, and its value: slow dimensions change seldom.
    std::string text;
    HeldValue value{};
  };
  /// The places in the cells of one block that hold the value of a key.
  struct Found {
    std::vector<Giver> givers;  ///< the first that gives a value counts
    std::optional<HeldValue> otherwise;
  };

  std::vector<Found> find_keys(const Cells& cells, std::size_t block) const;
  /// Sets the value that the cell gives there; false if it gives none.
  static bool gives(Giver& giver, const Cells& cells, const Cells::Place& place, WhereValue& value);
  WhereValue value_of(std::size_t key, const Cells& cells, const Cells::Place& place, const Default& otherwise);

  std::span<const Where> conditions_;
  std::vector<Key> keys_;                             // keys of all conditions, each once
  std::vector<std::vector<std::size_t>> keys_of_;     // keys of each condition
  std::map<std::size_t, std::vector<Found>> blocks_;  // places of the values, by block and key
  std::vector<WhereValue> values_;                    // values of the keys of one condition
};

}  // namespace polhode::study::plan
