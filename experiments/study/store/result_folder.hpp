// SPDX-License-Identifier: BSD-3-Clause
// The folder of a study's results: never shared by two programs at a time, never overwritten by a different study.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace polhode::study::inline store {

class ResultFolder {
 public:
  /// Checks, creates and locks the folder. `ids` are the runs of the study that wants in: it may be the study that is
  /// there already, or a wider one. Throws InputError, having written nothing.
  ResultFolder(const std::filesystem::path& path, const std::set<std::string>& ids, bool force);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

 private:
  [[noreturn]] void fail(const std::string& why);
  int lock_ = -1;
};

}  // namespace polhode::study
