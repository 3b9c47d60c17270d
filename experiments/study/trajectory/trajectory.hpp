// SPDX-License-Identifier: BSD-3-Clause
// Writes the motion of a run while it runs: trajectory.csv, energy.csv and events.csv, or trajectory.h5.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "core/run/simulate.hpp"

namespace polhode::study::inline trajectory {

enum class TrajectoryFormat { none, csv, hdf5 };

/// A trajectory cannot be written. This is not a failure of the run; its results are not kept. what() names the file
/// and the reason.
class TrajectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An observer that writes each sample. Rows are flushed regularly, so that a killed
/// run leaves its rows so far. Memory does not grow with the run.
class TrajectoryWriter : public Observer {
 public:
  /// Finishes the files. Throws TrajectoryError if they cannot be written; a full disk is reported here at the latest.
  virtual void close() = 0;
};

/// Creates `folder` and the files in it; null for TrajectoryFormat::none. Throws TrajectoryError.
std::unique_ptr<TrajectoryWriter> open_trajectory(TrajectoryFormat format, const std::filesystem::path& folder,
                                                  const System<double>& system);

}  // namespace polhode::study::trajectory
