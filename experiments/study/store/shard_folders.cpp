// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/shard_folders.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "experiments/study/store/store.hpp"

namespace polhode::study::inline store {

namespace fs = std::filesystem;

fs::path shard_folder(const fs::path& study, std::size_t number, std::size_t count) {
  return study / folder_of_shards / (std::to_string(number) + "_of_" + std::to_string(count));
}

std::vector<fs::path> shard_folders(const fs::path& study) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(study / folder_of_shards, none)) {
    if (fs::exists(entry.path() / Store::file_name, none)) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace polhode::study::store
