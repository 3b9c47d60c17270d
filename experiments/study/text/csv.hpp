// SPDX-License-Identifier: BSD-3-Clause
// Writes rows of CSV files (RFC 4180).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline text {

/// Writes one row, cell by cell, at the end of a text.
class CsvRow {
 public:
  explicit CsvRow(std::string& text) : text_(text) {}

  /// A cell with a comma, a quote or a line break is quoted.
  void add(std::string_view cell);
  void add(std::int64_t number);
  /// A number with all its digits; an empty cell if it is absent or not finite.
  void add(double number);
  void add(const std::optional<double>& number);
  void end() { text_ += '\n'; }

 private:
  void separate();

  std::string& text_;
  bool first_ = true;
};

/// One row with its line break.
std::string csv_row(const std::vector<std::string>& cells);

/// A number with all its digits; empty if it is absent or not finite.
inline std::string csv_cell(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? exact(*x) : std::string();
}

}  // namespace polhode::study::text
