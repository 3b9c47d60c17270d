// SPDX-License-Identifier: BSD-3-Clause
// Results folder of a study: locked against other programs, and protected from being overwritten by a different study.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "experiments/study/store/folder_lock.hpp"

namespace polhode::study::inline store {

/// True for the id of a run of the study.
using BelongsToStudy = std::function<bool(std::uint64_t id)>;

/// Remedy where a study cannot use a folder.
constexpr std::string_view another_folder = "name another folder with --out, or overwrite it with --force";

/// Throws InputError if the folder, or one of its shards, has results of runs that do not belong to the study.
void refuse_other_study(const std::filesystem::path& path, const BelongsToStudy& belongs);

class ResultFolder {
 public:
  /// Checks, creates and locks the folder. All runs already stored there must belong to the study, unless `force` is
  /// set, which removes the results of a different study. Throws InputError if the folder cannot be used, and leaves
  /// existing results unchanged.
  ResultFolder(const std::filesystem::path& path, const BelongsToStudy& belongs, bool force);

 private:
  std::optional<FolderLock> lock_;
};

}  // namespace polhode::study::store
