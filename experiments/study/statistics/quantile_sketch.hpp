// SPDX-License-Identifier: BSD-3-Clause
// Quantiles of any number of values in bounded memory. Each value is counted in a bin of constant relative width, so
// that a quantile is within 1 % of a value that has its rank. Source: Masson, Rim & Lee, DDSketch, VLDB 12 (2019) 2195.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>

namespace polhode::study::inline statistics {

class QuantileSketch {
 public:
  static constexpr double relative_error = 0.01;

  /// `value` is finite.
  void add(double value);

  std::uint64_t count() const { return count_; }
  double least() const { return least_; }      ///< exact; infinite if there are no values
  double largest() const { return largest_; }  ///< exact

  /// The value of rank share·(count − 1), 0 <= share <= 1, within relative_error; the ends are exact. Absent if there
  /// are no values.
  std::optional<double> quantile(double share) const;

 private:
  std::map<std::int32_t, std::uint64_t> negative_, positive_;  // counts by number of the bin
  std::uint64_t zeros_ = 0, count_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), largest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace polhode::study::statistics
