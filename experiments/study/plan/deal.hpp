// SPDX-License-Identifier: BSD-3-Clause
// Deals the runs of a study to shards. The plan alone decides which runs a shard has, so that the processes need not
// communicate.
#pragma once

#include <cstddef>
#include <vector>

#include "experiments/study/plan/plan.hpp"

namespace polhode::study::inline plan {

/// Number (1 … count) of the shard of each run of the plan, in the order of its runs. Costs are dealt evenly: the
/// dearest run first, each to the shard with the least cost so far. Runs that are refused have the number 0.
std::vector<std::size_t> deal(const Plan& plan, std::size_t count);

}  // namespace polhode::study::plan
