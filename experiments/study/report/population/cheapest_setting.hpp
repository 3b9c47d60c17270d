// SPDX-License-Identifier: BSD-3-Clause
// The answer of a study with too many runs to be held: which method at which step or tolerance reaches an error in
// nearly all runs at the least cost. Each run is counted once and forgotten.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "experiments/study/record/analysis.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/statistics/quantile_sketch.hpp"

namespace polhode::study::inline report::inline population {

class CheapestSetting {
 public:
  void add(const RunRecord& run);

  /// A refused run does not count; a run that broke off reaches no error.
  Answer answer() const;

 private:
  /// Errors for which an answer may be given, the most usual first: 10 to these powers (rad, or m).
  static constexpr std::array decades = {-3, -2, -4, -1, -5, -6, -7, -8, -9, -10};
  static const std::array<double, decades.size()> limits;  ///< these powers
  static constexpr std::size_t most_settings = 1000;

  /// A method at a step or a tolerance.
  struct Setting {
    std::size_t runs = 0, with_error = 0;
    std::array<std::size_t, decades.size()> reached{};  ///< runs with an error of at most that power
    QuantileSketch cost;                                ///< right-hand sides
  };
  using Key = std::tuple<std::string, bool, double>;  ///< method, adaptive, step (s) or tolerance
  using Settings = std::map<Key, Setting>;

  std::map<std::string, Settings::const_iterator> cheapest(const Settings& settings, std::size_t decade) const;
  Answer ranked(const Settings& settings, const char* what, const char* unit) const;

  Settings attitude_, position_;  ///< settings for the attitude and for the position
  std::map<std::string, std::size_t> outcomes_;
  bool too_many_ = false;
};

}  // namespace polhode::study::report::population
