// SPDX-License-Identifier: BSD-3-Clause
// Reads a CSV file with a header strictly: every complaint says file, line and column. Lines that start with # and empty
// ones are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polhode::study {

class CsvReader {
 public:
  /// Reads the whole file and its header. Throws InputError.
  explicit CsvReader(const std::string& path);

  const std::vector<std::string>& header() const { return header_; }
  /// The place of a column in the header; absent: there is none. Throws InputError if there are two.
  std::optional<std::size_t> column(std::string_view name) const;

  /// The next row, which has as many cells as the header; false: there is none. Throws InputError.
  bool next();
  const std::string& text(std::size_t column) const { return cells_[column].text; }
  /// Throw InputError where the cell is no finite number, or no whole number from 0 on.
  double number(std::size_t column) const;
  std::uint64_t count(std::size_t column) const;

  /// Throws InputError: "pairs.csv:3:7: ahx: " and why.
  [[noreturn]] void fail(std::size_t column, const std::string& why) const;

 private:
  struct Cell {
    std::string text;
    std::size_t at;  ///< counted from 1
  };
  bool next_line();
  void split();
  [[noreturn]] void fail_at(std::size_t character, const std::string& why) const;

  std::string path_, content_;
  std::string_view line_;
  std::size_t offset_ = 0, line_number_ = 0;
  std::vector<std::string> header_;
  std::vector<Cell> cells_;
};

}  // namespace polhode::study
