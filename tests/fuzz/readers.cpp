// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/readers.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>
#include <vector>

namespace polhode::fuzz {

std::span<const Reader> readers() {
  static const std::vector<Reader> all = {scenario_reader(), study_reader(), trajectory_reader(), obj_reader(),
                                          pairs_reader(),    boxes_reader(), cells_reader(),
#ifdef POLHODE_HAS_VIEWER
                                          session_reader()
#endif
  };
  return all;
}

const Reader* find_reader(std::string_view name) {
  for (const Reader& reader : readers()) {
    if (reader.name == name) return &reader;
  }
  return nullptr;
}

MemoryFile::MemoryFile(std::string_view bytes) : file_(memfd_create("input", 0)) {
  if (file_ < 0) throw std::runtime_error("no file in memory can be made");
  path_ = "/proc/self/fd/" + std::to_string(file_);
  for (std::size_t at = 0; at < bytes.size();) {
    const auto written = write(file_, bytes.data() + at, bytes.size() - at);
    if (written <= 0) throw std::runtime_error("a file in memory cannot be written");
    at += static_cast<std::size_t>(written);
  }
}
MemoryFile::~MemoryFile() { close(file_); }

}  // namespace polhode::fuzz
