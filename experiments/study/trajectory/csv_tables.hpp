// SPDX-License-Identifier: BSD-3-Clause
// Writes a trajectory as trajectory.csv, energy.csv, events.csv and, with joints, reactions.csv.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/system/system.hpp"

namespace polhode::study::inline trajectory {

/// A table of doubles written row by row. Throws TrajectoryError where it cannot be written.
class CsvTable {
 public:
  CsvTable(std::filesystem::path path, const std::vector<std::string>& columns);
  CsvTable(const CsvTable&) = delete;
  CsvTable& operator=(const CsvTable&) = delete;
  ~CsvTable();

  /// `word`: a text that stands in the second column, between the numbers.
  void add(const std::vector<double>& row, std::string_view word = {});
  void flush();
  void close();

 private:
  void write(std::string_view text);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::FILE* file_;
  fmt::memory_buffer line_;
};

class CsvTables {
 public:
  CsvTables(const std::filesystem::path& folder, const System<double>& system);
  void trajectory(const std::vector<double>& row) { trajectory_.add(row); }
  void energy(const std::vector<double>& row) { energy_.add(row); }
  void reaction(const std::vector<double>& row) { reactions_->add(row); }
  void impact(const std::vector<double>& row) { events_.add(row, "impact"); }
  void slide_end(const std::vector<double>& row) { events_.add(row, "slide_end"); }
  void flush();
  void close();

 private:
  std::vector<CsvTable*> tables();

  CsvTable trajectory_, energy_, events_;
  std::optional<CsvTable> reactions_;  ///< reactions of a system with joints
};

}  // namespace polhode::study::trajectory
