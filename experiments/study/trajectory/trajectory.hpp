// SPDX-License-Identifier: BSD-3-Clause
// Writes the motion of a run as it happens: trajectory.csv, energy.csv and events.csv, or trajectory.h5.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "core/run/simulate.hpp"

namespace polhode::study::inline trajectory {

enum class TrajectoryFormat { none, csv, hdf5 };

/// A trajectory cannot be written: no fault of the run, whose results are not kept. what() names the file and the
/// reason.
class TrajectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An observer that writes each sample and hands it on to the next one. Rows are flushed as it goes, so that a run that
/// is killed leaves what it had done; memory does not grow with the run.
class TrajectoryWriter : public Observer {
 public:
  /// Throws TrajectoryError when the file cannot be written (a full disk shows at the latest in close()).
  virtual void close() = 0;
};

/// Creates `folder` and the files in it; `next` sees every sample too. Throws TrajectoryError.
std::unique_ptr<TrajectoryWriter> open_trajectory(TrajectoryFormat format, const std::filesystem::path& folder,
                                                  const System<double>& system);

}  // namespace polhode::study
