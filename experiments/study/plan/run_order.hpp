// SPDX-License-Identifier: BSD-3-Clause
// The order of the runs of a study by their configurations. Of each run only the values that differ between runs are
// held, 16 bytes each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline plan {

class RunOrder {
 public:
  /// `expected`: number of runs, for which room is made.
  explicit RunOrder(std::size_t expected = 0) : expected_(expected) {}

  /// Adds the next run by its sort_key(), or by the two parts of it. All keys have the same length.
  void add(const std::vector<OptionValue>& key, const std::vector<OptionValue>& rest = {});

  /// Numbers of all runs in their order, from 0. `before` decides between runs of equal keys.
  std::vector<std::uint32_t> sorted(const std::function<bool(std::uint32_t, std::uint32_t)>& before) const;

  /// The different values of one place of the keys: how many they are, and the first runs that have them.
  struct Values {
    std::size_t count = 0;
    std::vector<std::uint32_t> runs;
  };
  /// Values of each place of the keys, as they are met in these runs; at most `most` runs are named.
  std::vector<Values> values(std::span<const std::uint32_t> runs, std::size_t most) const;

 private:
  /// Type of a value, and bits that are ordered like the values of that type; a text has the number of a word.
  using Code = std::pair<std::uint8_t, std::uint64_t>;
  /// The values of one place of the keys. Empty while all are equal to the first one.
  struct Column {
    OptionValue first;
    std::vector<Code> codes;
    std::unordered_map<std::string, std::uint64_t> words;
  };
  static Code code_of(const OptionValue& value, Column& column);

  std::vector<Column> columns_;
  std::size_t runs_ = 0, expected_;
};

}  // namespace polhode::study::plan
