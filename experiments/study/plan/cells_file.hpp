// SPDX-License-Identifier: BSD-3-Clause
// A table of cells as CSV: each row is a point of a study. Columns are named after options (dt, t_end) or keys of the
// scenario (body.0.mass). An empty cell leaves its key out of that row.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline plan {

class CellsFile {
 public:
  /// Reads the file and checks the values of all options. Throws InputError with file, line and column.
  static std::shared_ptr<const CellsFile> read(const std::string& path);

  const std::string& path() const { return path_; }
  const std::vector<std::string>& keys() const { return keys_; }
  const std::vector<std::string>& labels() const { return labels_; }  ///< places of the columns: "cells.csv:1:4: dt"
  std::size_t rows() const { return lines_.size(); }
  std::size_t column(std::string_view key) const;  ///< the file must have the key

  std::string_view text(std::size_t row, std::size_t column) const;
  std::string place(std::size_t row, std::size_t column) const;  ///< "cells.csv:7: body.0.mass"

 private:
  std::string path_;
  std::vector<std::string> keys_, labels_;
  std::vector<std::uint32_t> lines_;  ///< line of each row in the file
  std::string texts_;                 ///< all cells, row by row, one behind the other
  std::vector<std::size_t> ends_;     ///< end of each cell in texts_
};

}  // namespace polhode::study::plan
