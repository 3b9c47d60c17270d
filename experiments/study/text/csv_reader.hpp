// SPDX-License-Identifier: BSD-3-Clause
// Reads tables of numbers that any program wrote as CSV (RFC 4180), row by row. The first line names the columns, which
// may be in any order; unknown columns are skipped. Lines may end in CR LF. Empty lines and lines that begin with # are
// skipped. Every error is an InputError with file, line, column and a remedy; so are a line of more than 1 MiB, a zero
// byte, and a file without an end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline text {

class CsvReader {
 public:
  /// Opens a file of at most `most` bytes and reads the names of its columns.
  explicit CsvReader(const std::string& path, std::size_t most = 1024 * mebibyte);

  const std::vector<std::string>& names() const { return names_; }

  /// Index of a required column. Throws if it is missing or there twice.
  std::size_t column(std::string_view name) const;
  std::vector<std::size_t> columns(
      const std::vector<std::string>& names) const;  ///< indices of several required columns

  /// Reads the next row; false at the end of the file.
  bool next();

  std::size_t line() const { return line_number_; }  ///< line of the present row, from 1

  /// Place of a cell of the present row, or of a name while no row is read: "boxes.csv:3:8".
  std::string place(std::size_t column) const;

  const std::string& text(std::size_t column) const { return cells_[column]; }
  std::int64_t integer(std::size_t column) const;
  double number(std::size_t column) const;  ///< may be infinite ("inf"), never NaN

  /// Throws an error about a cell of the present row: "boxes.csv:3:8: hx is negative; …".
  [[noreturn]] void fail(std::size_t column, const std::string& what) const;

 private:
  bool next_line();
  bool read_line();
  void split();
  std::string name_and(std::size_t column) const;
  [[noreturn]] void fail_at(std::size_t character, const std::string& what) const;

  std::string path_;
  std::ifstream file_;
  std::size_t most_, bytes_ = 0;
  std::vector<char> buffer_;  // one line
  std::size_t line_number_ = 0;
  std::string line_;
  std::vector<std::string> names_;
  std::vector<std::string> cells_;
  std::vector<std::size_t> places_;  // column of each cell's first character, from 1
};

}  // namespace polhode::study::text
