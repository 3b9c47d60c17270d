// SPDX-License-Identifier: BSD-3-Clause
// The readers of files that fuzzers try, one entry each. To add a reader: a file here, and a line in readers.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace polhode::fuzz {

struct Reader {
  const char* name;
  /// Reads the bytes as a file. Input that the reader refuses, with an exception made for that, is no error; any other
  /// exception is.
  void (*read)(std::string_view bytes);
  /// Words of the file's format, from which inputs are made.
  std::span<const std::string_view> words;
};

std::span<const Reader> readers();
/// The reader of this name; null if there is none.
const Reader* find_reader(std::string_view name);

/// A file in memory, for readers that take a path.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();
  const std::string& path() const { return path_; }

 private:
  int file_;
  std::string path_;
};

Reader scenario_reader();
Reader study_reader();
Reader trajectory_reader();
Reader obj_reader();
Reader pairs_reader();
Reader boxes_reader();
Reader cells_reader();
Reader session_reader();  ///< reader of sessions, defined only if the viewer is built

}  // namespace polhode::fuzz
