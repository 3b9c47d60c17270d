// SPDX-License-Identifier: BSD-3-Clause
// Writes rows as a table for the terminal, CSV, Markdown or LaTeX, to standard output or a file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/record/run_record.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::results {

enum class Format { table, csv, markdown, latex };
/// The format with this name. Throws std::logic_error if there is none.
Format format_of(const std::string& name);

/// Adds a row of CSV, with all digits of its numbers, to a text.
void add_csv_row(std::string& text, const std::vector<OptionValue>& row);

class Output {
 public:
  /// `file`: empty for standard output. Rows of CSV are written at once, those of the others by finish(). Throws
  /// WriteError.
  Output(Format format, const std::string& file, std::vector<std::string> names);

  /// Values of one row, as many as names. CSV has all digits, the others have five.
  void add(const std::vector<OptionValue>& row);
  /// Rows of CSV, as add_csv_row() has made them.
  void add_csv_rows(const std::string& text, std::size_t rows);
  void finish();  ///< gives the file its name
  std::size_t rows() const { return count_; }

 private:
  void write(const std::string& text);

  Format format_;
  std::optional<TextFile> file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<bool> is_text_;  ///< one value for each column
  std::size_t count_ = 0;
};

}  // namespace polhode::study::results
