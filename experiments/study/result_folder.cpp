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
    for (const char* name : {"runs.csv", "trajectory.csv", "manifest.json", "report.html"}) {
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
  if (std::filesystem::exists(path, error) && !force) refuse_other_study(path, ids);
  std::filesystem::create_directories(path, error);
  if (error) throw InputError("--out: cannot create " + path.string() + ": " + error.message());
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    throw InputError("--out: cannot write into " + path.string() + ": " + std::strerror(errno));
  }
  lock_ = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw InputError("--out: another program is writing into " + path.string() + "; wait for it, or name another folder");
  }
}

ResultFolder::~ResultFolder() {
  if (lock_ >= 0) close(lock_);
}

}  // namespace polhode::study
