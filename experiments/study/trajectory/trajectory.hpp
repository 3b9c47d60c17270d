// SPDX-License-Identifier: BSD-3-Clause
// Writes the motion of a run while it runs: trajectory.csv, energy.csv and events.csv, or trajectory.h5 (README.md).
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>

#include "core/run/simulate.hpp"
#include "experiments/study/trajectory/trajectory_files.hpp"

namespace polhode::study::inline trajectory {

/// An observer that writes each sample. Memory does not grow with the run.
class TrajectoryWriter : public Observer {
 public:
  /// Closes the files; finish_trajectories() then gives them their names. Throws TrajectoryError if they cannot be
  /// written; a full disk is reported here at the latest.
  virtual void close() = 0;
};

/// The end of a block of rows, at an instant. Its rows, in all tables, are then in the hands of the operating system: a
/// kill of the program cannot take them away.
/// system: a kill of the program cannot take it away.
struct BlockEnd {
  std::size_t rows = 1000;              ///< rows of the trajectory, at most, unless one instant has more
  std::chrono::milliseconds age{1000};  ///< time from which the first instant ends the block
};

/// Creates `folder` and the files in it; null for TrajectoryFormat::none. Throws TrajectoryError.
std::unique_ptr<TrajectoryWriter> open_trajectory(TrajectoryFormat format, const std::filesystem::path& folder,
                                                  const System<double>& system, BlockEnd block = {});

}  // namespace polhode::study::trajectory
