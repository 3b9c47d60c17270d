// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "experiments/study/input_error.hpp"
#include "experiments/study/store.hpp"

namespace polhode::study {
namespace {

/// What a study writes beside its store.
constexpr const char* products[] = {"runs.csv",       "timings.csv", "manifest.json", "report.html", "figures", "tables",
                                    "trajectories",   "trajectory.csv", "energy.csv",  "events.csv",  "trajectory.h5",
                                    "replay.html"};

bool holds_only(const std::filesystem::path& path, const std::set<std::string>& ids) {
  try {
    const std::set<std::string> stored = Store::ids_in(path);
    return std::includes(ids.begin(), ids.end(), stored.begin(), stored.end()) && !stored.empty();
  } catch (const std::runtime_error&) {
    return false;  // damaged
  }
}

void refuse_other_study(const std::filesystem::path& path, const std::set<std::string>& ids) {
  const std::string remedy = "; name another folder with --out, or overwrite it with --force";
  std::set<std::string> stored;
  try {
    stored = Store::ids_in(path);
  } catch (const std::runtime_error& error) {
    throw InputError("--out: " + std::string(error.what()) + remedy);
  }
  if (!std::includes(ids.begin(), ids.end(), stored.begin(), stored.end())) {
    throw InputError("--out: " + path.string() + " holds the results of a different study" + remedy);
  }
  if (!std::filesystem::exists(path / Store::file_name)) {
    for (const char* name : products) {
      if (std::filesystem::exists(path / name)) {
        throw InputError("--out: " + (path / name).string() + " is there already" + remedy);
      }
    }
  }
}

}  // namespace

ResultFolder::ResultFolder(const std::filesystem::path& path, const std::set<std::string>& ids, bool force) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error)) {
    throw InputError("--out: " + path.string() + " is not a folder");
  }
  std::filesystem::create_directories(path, error);
  if (error) throw InputError("--out: cannot create " + path.string() + ": " + error.message());
  // Locked before it is read, so that of two programs only one sees a folder that is just being filled.
  lock_ = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    fail("another program is writing into " + path.string() + "; wait for it, or name another folder");
  }
  // For root every folder looks writable until one tries.
  const std::filesystem::path probe = path / ".writable";
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) fail("cannot write into " + path.string() + ": " + std::strerror(errno));
  close(file);
  std::filesystem::remove(probe, error);
  if (!force) {
    try {
      refuse_other_study(path, ids);
    } catch (...) {
      close(lock_);
      throw;
    }
  } else if (!holds_only(path, ids)) {  // nothing of the other study stays
    for (const char* name : products) std::filesystem::remove_all(path / name, error);
    for (const char* suffix : {"", "-wal", "-shm"}) {
      std::filesystem::remove(path / (std::string(Store::file_name) + suffix), error);
    }
  }
}

void ResultFolder::fail(const std::string& why) {
  close(lock_);
  throw InputError("--out: " + why);
}

ResultFolder::~ResultFolder() {
  if (lock_ >= 0) close(lock_);
}

}  // namespace polhode::study
