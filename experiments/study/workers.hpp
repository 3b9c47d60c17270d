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

/// Carries out a batch; returns one result for each of its runs. It may store the share of its work that is done, 0 to
/// 1, into `share`.
using Work = std::function<std::vector<RunResult>(const Batch&, std::atomic<double>& share)>;

/// Does what must be done before the results of runs are put into the store.
using Finish = std::function<void(const std::vector<RunRecord>&)>;

/// Calls work(batch) for each batch, `jobs` at a time (0: one for each core), then finish(runs) for several runs at a
/// time, and puts the results into the store and into `results`. No batch begins once no_more is set, which an
/// exception does as well; finished runs are kept. Rethrows exceptions of `work`, `finish` and the store.
void run_all(const std::string& name, std::vector<Batch> batches, const Work& work, const Finish& finish, int jobs,
             Store& store, std::atomic<bool>& no_more, std::map<std::string, RunResult>& results);

}  // namespace polhode::study
