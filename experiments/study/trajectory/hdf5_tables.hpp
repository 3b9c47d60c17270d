// SPDX-License-Identifier: BSD-3-Clause
// Writes a trajectory as trajectory.h5, in SWMR mode: what was flushed can be read after a kill.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/system/system.hpp"
#include "experiments/study/trajectory/hdf5_file.hpp"

namespace polhode::study::inline trajectory {

/// A two-dimensional dataset that grows.
class Hdf5Table {
 public:
  Hdf5Table(hid_t file, const char* name, const std::vector<std::string>& columns)
      : set_(create_hdf5_table(file, name, columns)), width_(columns.size()) {}

  explicit operator bool() const { return static_cast<bool>(set_); }

  /// Keeps a row until the next write; false if HDF5 reports an error.
  bool add(const std::vector<double>& row);
  bool write();
  bool close() { return set_.close(); }

 private:
  Hdf5Handle set_;
  hsize_t width_, rows_ = 0;
  std::vector<double> pending_;
};

/// All functions throw TrajectoryError where the file cannot be written.
class Hdf5Tables {
 public:
  Hdf5Tables(const std::filesystem::path& folder, const System<double>& system);
  void trajectory(const std::vector<double>& row) { add(trajectory_, row); }
  void energy(const std::vector<double>& row) { add(energy_, row); }
  void reaction(const std::vector<double>& row) { add(*reactions_, row); }
  void impact(const std::vector<double>& row) { add(impacts_, row); }
  void slide_end(const std::vector<double>& row) { add(slide_ends_, row); }
  void flush();
  void close();

 private:
  std::vector<Hdf5Table*> tables();
  void add(Hdf5Table& table, const std::vector<double>& row);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  Hdf5Handle file_;
  Hdf5Table trajectory_, energy_, impacts_, slide_ends_;
  std::optional<Hdf5Table> reactions_;  ///< reactions of a system with joints
};

}  // namespace polhode::study::trajectory
