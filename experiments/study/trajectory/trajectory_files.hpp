// SPDX-License-Identifier: BSD-3-Clause
// The files of a trajectory: their names, and how they get them. A file is written under the name NAME.unfinished. When
// all files of a run are whole and on the disk, they are renamed, trajectory.csv or trajectory.h5 last.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace polhode::study::inline trajectory {

enum class TrajectoryFormat { none, csv, hdf5 };

/// A trajectory cannot be written. This is not a failure of the run; its results are not kept. what() names the file
/// and the reason.
class TrajectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws TrajectoryError. `reason`: errno; 0: unknown.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int reason);

/// Names of the files of a format, in the order in which they are renamed.
const std::vector<std::string>& trajectory_files(TrajectoryFormat format);

/// File of the reactions, which a trajectory in CSV of a system with joints has besides. It is renamed first.
inline constexpr const char* reactions_file = "reactions.csv";

/// Path of a file that is not finished.
std::filesystem::path unfinished(const std::filesystem::path& path);

/// True if all files of the format stand in the folder, and none of them is there unfinished as well.
bool has_trajectory(TrajectoryFormat format, const std::filesystem::path& folder);

/// Waits until the contents of a file, or the names in a folder, are on the disk. Throws TrajectoryError, which names
/// `named`.
void sync_to_disk(const std::filesystem::path& path, const std::filesystem::path& named);

/// Creates the folder of a trajectory. Removes what an interrupted run has left unfinished in it. Throws
/// TrajectoryError.
void begin_trajectory(const std::filesystem::path& folder);

/// Gives the closed files of the trajectories in these folders, which lie on one file system, their names, as soon as
/// their contents are on the disk; it waits for that once for all of them, since it takes milliseconds. After a crash
/// of the machine a name may be missing, never what it names. Throws TrajectoryError.
void finish_trajectories(TrajectoryFormat format, const std::vector<std::filesystem::path>& folders);

}  // namespace polhode::study::trajectory
