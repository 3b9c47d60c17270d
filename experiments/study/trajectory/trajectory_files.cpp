// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/trajectory_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace polhode::study::inline trajectory {
namespace {

namespace fs = std::filesystem;

/// `wait`: fsync or syncfs.
void wait_for_disk(const fs::path& path, const fs::path& named, int (*wait)(int)) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) cannot_write(named, errno);
  int reason = wait(file) == 0 ? 0 : errno;
  if (reason == EINVAL || reason == ENOTSUP) reason = 0;  // the file system has no such thing
  if (close(file) != 0 && reason == 0) reason = errno;
  if (reason != 0) cannot_write(named, reason);
}

}  // namespace

void cannot_write(const fs::path& path, int reason) {
  throw TrajectoryError("cannot write " + path.string() +
                        (reason != 0 ? std::string(": ") + std::strerror(reason) : ""));
}

const std::vector<std::string>& trajectory_files(TrajectoryFormat format) {
  static const std::vector<std::string> none, csv = {"energy.csv", "events.csv", "trajectory.csv"},
                                              hdf5 = {"trajectory.h5"};
  return format == TrajectoryFormat::csv ? csv : format == TrajectoryFormat::hdf5 ? hdf5 : none;
}

fs::path unfinished(const fs::path& path) { return path.string() + ".unfinished"; }

bool has_trajectory(TrajectoryFormat format, const fs::path& folder) {
  const auto& names = trajectory_files(format);
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    std::error_code error;
    return fs::exists(folder / name, error) && !fs::exists(unfinished(folder / name), error);
  });
}

void sync_to_disk(const fs::path& path, const fs::path& named) { wait_for_disk(path, named, fsync); }

void begin_trajectory(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw TrajectoryError("cannot create the folder " + folder.string() + ": " + error.message());
  for (const auto any : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    for (const std::string& name : trajectory_files(any)) {
      fs::remove(unfinished(folder / name), error);
      if (error) cannot_write(folder / name, error.value());
    }
  }
  fs::remove(unfinished(folder / reactions_file), error);
  if (error) cannot_write(folder / reactions_file, error.value());
}

void finish_trajectories(TrajectoryFormat format, const std::vector<fs::path>& folders) {
  const auto& names = trajectory_files(format);
  if (names.empty() || folders.empty()) return;
  const auto made =
      std::find_if(folders.begin(), folders.end(), [](const fs::path& folder) { return fs::exists(folder); });
  if (made != folders.end()) wait_for_disk(*made, *made / names.back(), syncfs);
  for (const fs::path& folder : folders) {
    // A run that failed before its start has no files.
    if (std::none_of(names.begin(), names.end(),
                     [&](const auto& name) { return fs::exists(unfinished(folder / name)); })) {
      continue;
    }
    std::vector<std::string> made_files = names;
    if (fs::exists(unfinished(folder / reactions_file))) made_files.insert(made_files.begin(), reactions_file);
    for (const std::string& name : made_files) {
      const fs::path path = folder / name;
      if (std::rename(unfinished(path).c_str(), path.c_str()) != 0) cannot_write(path, errno);
    }
  }
}

}  // namespace polhode::study::trajectory
