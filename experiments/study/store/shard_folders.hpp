// SPDX-License-Identifier: BSD-3-Clause
// Folders of the results of shards, in the folder of a study. Each has a store and a lock of its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace polhode::study::inline store {

inline constexpr const char* folder_of_shards = "shards";

/// Folder of shard `number` of `count`: shards/3_of_16.
std::filesystem::path shard_folder(const std::filesystem::path& study, std::size_t number, std::size_t count);

/// Folders of all shards that have a store, however many shards there were, in the order of their names.
std::vector<std::filesystem::path> shard_folders(const std::filesystem::path& study);

}  // namespace polhode::study::store
