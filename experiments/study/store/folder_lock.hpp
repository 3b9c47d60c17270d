// SPDX-License-Identifier: BSD-3-Clause
// Lock on a folder of results: of all programs that take it, one at a time has it. The system releases it when the
// program ends, however it ends.
//
// The lock is taken twice: with flock on the folder, and with fcntl on the file results.lock in it, whose text names
// the owner. On a local file system either is enough. flock on a folder does not work over NFS, and where a cluster
// mounts Lustre without `flock` or with `localflock` neither acts on another machine: nothing protects the folder from
// a second writer on another machine there, and the words in results.lock are all that remains.
#pragma once

#include <filesystem>
#include <string>

namespace polhode::study::inline store {

class FolderLock {
 public:
  /// Locks an existing folder. Throws std::runtime_error, with the folder, the reason and the remedy in one line, if it
  /// cannot be read, written or locked; what() names the program that has the lock.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Words of the program that has the lock, or had it when it was killed:
  /// " (process 123 on host n1, since 2026-01-31 12:00:00 UTC: energy_drift --dt 0.1)"; empty if there are none.
  static std::string holder(const std::filesystem::path& folder);

  static constexpr const char* file_name = "results.lock";

 private:
  void release();

  std::filesystem::path folder_;
  int folder_handle_ = -1, file_handle_ = -1;
  bool held_ = false;
};

}  // namespace polhode::study::store
