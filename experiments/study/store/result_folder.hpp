// SPDX-License-Identifier: BSD-3-Clause
// Results folder of a study: locked against other programs, and protected from being overwritten by a different study.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "experiments/study/store/folder_lock.hpp"

namespace polhode::study::inline store {

/// Throws InputError if the folder, or one of its shards, has results that are not those of the runs `ids`.
void refuse_other_study(const std::filesystem::path& path, const std::set<std::string>& ids);

class ResultFolder {
 public:
  /// Checks, creates and locks the folder. `ids`: the runs of the study; they must include all runs already stored
  /// there, unless `force` is set, which removes the results of a different study. Throws InputError if the folder
  /// cannot be used, and leaves existing results unchanged.
  ResultFolder(const std::filesystem::path& path, const std::set<std::string>& ids, bool force);

 private:
  std::optional<FolderLock> lock_;
};

}  // namespace polhode::study::store
