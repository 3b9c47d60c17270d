// SPDX-License-Identifier: BSD-3-Clause
// The state of a trajectory in a folder: all of it, or the rest that a kill, a full disk or damage has left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/trajectory/trajectory_files.hpp"

namespace polhode::study::inline trajectory {

struct KeptTrajectory {
  enum class Condition {
    whole,       ///< finished: all files have their names, and hold the same instants
    unfinished,  ///< the run was cut off, or is under way
    damaged      ///< something is missing, or is not what a run writes
  };
  /// A table, and how much of it belongs to the instants.
  struct Table {
    std::string name;            ///< name of its file, or of its dataset in an HDF5 file
    std::filesystem::path file;  ///< file in which it now is
    std::uint64_t rows = 0;
    std::uint64_t bytes = 0;  ///< length of that part of a CSV file, bytes
  };

  TrajectoryFormat format = TrajectoryFormat::none;
  std::filesystem::path folder;
  Condition condition = Condition::whole;
  std::uint64_t instants = 0;  ///< number of instants, from the start, at which all tables are complete
  double t_last = 0;           ///< time of the last of them, s
  std::vector<Table> tables{};
  std::string fault{};  ///< damage, with its place
};

/// Reads all files of the format in the folder; none if there is no such file.
std::optional<KeptTrajectory> kept_trajectory(const std::filesystem::path& folder, TrajectoryFormat format);

/// The same of one HDF5 file of any name.
KeptTrajectory kept_hdf5_file(const std::filesystem::path& path);

/// The trajectory in words: "unfinished, 12000 instants until t = 11.999 s".
std::string in_words(const KeptTrajectory& kept);

/// The advice for a trajectory that is not whole.
std::string remedy(const KeptTrajectory& kept);

/// Copies the instants into new files that say that they end early: trajectory.recovered.csv and so on, with a first
/// line that begins with #, or trajectory.recovered.h5, with the attributes ends_early and recovered_until_s. Returns
/// the path of the one with the motion. Throws TrajectoryError.
std::filesystem::path recover(const KeptTrajectory& kept);

}  // namespace polhode::study::trajectory
