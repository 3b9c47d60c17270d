// SPDX-License-Identifier: BSD-3-Clause
// The texts that --dry-run prints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/plan/shard.hpp"

namespace polhode::study {

/// The size of a large study in words: the number of its cells, and estimates of the numbers of runs and right-hand
/// sides. `chosen`: glance_at_plan().
std::string glance_text(const Experiment& experiment, const Plan& chosen);

/// The plan in words: the number of runs, how many of them are in the folder already (`done`: ids in ascending order),
/// how many will be refused and why, how many cells the conditions leave out, the values of each axis, and the first
/// points of tables.
std::string plan_text(const Experiment& experiment, const Plan& plan, const std::filesystem::path& folder,
                      const std::vector<std::uint64_t>& done);

/// Number of runs of a shard, and how many of them are done. `done`: sorted ids of finished runs.
std::string shard_text(const Plan& plan, const Shard& shard, const std::vector<std::uint64_t>& done);

}  // namespace polhode::study
