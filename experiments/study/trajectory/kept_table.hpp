// SPDX-License-Identifier: BSD-3-Clause
// Reads the rows of a table of a trajectory, as far as they go, from a file that may be unfinished or damaged.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace polhode::study::inline trajectory {

class KeptTable {
 public:
  virtual ~KeptTable() = default;

  /// Goes to the next row; false at the end, and at the first row that cannot be read.
  virtual bool next() = 0;

  double t = 0;       ///< time of the present row, s
  double second = 0;  ///< number in its second column; 0 in the events of a CSV file, where that is a word

  std::uint64_t rows = 0;   ///< number of rows up to the present one
  std::uint64_t bytes = 0;  ///< length of a CSV file up to the end of the present row, bytes
  bool cut = false;         ///< the last line of a CSV file has no end, or there is no line
  std::string fault;        ///< fault that ended the reading, with its place; empty at the end of the table
};

/// The table of a CSV file; empty with a fault if it cannot be opened. Rows are good if they have as many cells as the
/// first line and all of them, but those of `kind`, are numbers.
std::unique_ptr<KeptTable> kept_csv(const std::filesystem::path& path);

/// The table `name` of an open HDF5 file called `path`; its rows end before the first one that was never written.
std::unique_ptr<KeptTable> kept_hdf5(hid_t file, const std::string& name, const std::filesystem::path& path);

}  // namespace polhode::study::trajectory
