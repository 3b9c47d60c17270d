// SPDX-License-Identifier: BSD-3-Clause
// What --dry-run prints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/plan.hpp"

namespace polhode::study {

/// What is soon known of a large study: the number of its cells, and about how many runs and right-hand sides they are.
/// `chosen`: glance_at_plan().
std::string glance_text(const Experiment& experiment, const Plan& chosen);

/// The plan in words: the number of runs, how many of them are in the folder already (`done`: ids in ascending order),
/// how many will be refused and why, how many cells the conditions leave out, the values of each axis, and the first
/// points of tables.
std::string plan_text(const Experiment& experiment, const Plan& plan, const std::filesystem::path& folder,
                      const std::vector<std::uint64_t>& done);

}  // namespace polhode::study
