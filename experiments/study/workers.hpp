// SPDX-License-Identifier: BSD-3-Clause
// Carries out runs on several cores and stores finished runs at least ten times a second.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/study/plan/plan.hpp"
#include "experiments/study/store/store.hpp"

namespace polhode::study {

/// Runs that are carried out together by one call in one thread.
using Batch = std::vector<const PlannedRun*>;

/// Calls work(batch) for each batch, `jobs` at a time (0: one for each core), and puts the results, one for each run of
/// the batch, into the store and into `results`. If `stop` is set meanwhile, it returns early and finished runs are
/// kept. Rethrows exceptions of `work` and of the store.
void run_all(const std::string& name, std::vector<Batch> batches,
             const std::function<std::vector<RunResult>(const Batch&)>& work, int jobs, Store& store,
             std::atomic<bool>& stop, std::map<std::string, RunResult>& results);

}  // namespace polhode::study
