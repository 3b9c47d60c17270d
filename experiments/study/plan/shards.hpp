// SPDX-License-Identifier: BSD-3-Clause
// Shards: parts of a study that processes on any machines carry out apart. The plan alone decides which runs a shard
// has, so that processes need not speak with each other.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/plan/plan.hpp"

namespace polhode::study::inline plan {

/// Shard `number` of `count`; number: 1 … count.
struct Shard {
  std::size_t number = 1, count = 1;
};

inline constexpr std::size_t most_shards = 100'000;

/// Reads "3/16". Throws InputError that begins with the label.
Shard read_shard(const std::string& text, const std::string& label);

/// Number (1 … count) of the shard of each run of the plan, in the order of its runs. Costs are dealt evenly: the
/// dearest run first, each to the shard with the least cost so far. Runs that are refused have the number 0.
std::vector<std::size_t> deal(const Plan& plan, std::size_t count);

/// Folder of the results of a shard, in the folder of the study: shards/3_of_16.
std::filesystem::path shard_folder(const std::filesystem::path& study, const Shard& shard);

/// Folders of results of all shards in the folder of a study, in the order of their names; empty if there are none.
std::vector<std::filesystem::path> shard_folders(const std::filesystem::path& study);

}  // namespace polhode::study::plan
