// SPDX-License-Identifier: BSD-3-Clause
// Carries out runs of a plan on several cores and commits finished runs to the store ten times a second, and less
// often, down to once a second, where commits would take more than a tenth of the time. A run is made when a worker
// begins it, and forgotten when it is stored.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/plan/plan.hpp"
#include "experiments/study/store/store.hpp"

namespace polhode::study::inline workers {

/// Runs that are carried out together by one call in one thread.
using Batch = std::span<const PlannedRun>;

/// Receives the result of a run of a batch, by its number there.
using Finished = std::function<void(std::size_t run, RunResult&& result)>;

struct Work {
  /// Runs with the same non-empty key may be in one batch.
  std::function<std::string(const PlannedRun&)> key;
  /// Carries out a batch and passes each result on as soon as it is there. It may store the share of its work that is
  /// done, 0 to 1, into `share`.
  std::function<void(Batch, std::atomic<double>& share, const Finished&)> carry_out;
  /// Does what must be done before the results of runs are put into the store.
  std::function<void(const std::vector<RunRecord>&)> finish;
  /// Receives runs that were stored but perhaps not yet committed, with their numbers in the plan, and may move them
  /// elsewhere. May be empty.
  std::function<void(std::span<const std::uint32_t> numbers, std::span<RunRecord> runs)> stored{};
  /// Called by a worker before it takes further runs. May be empty.
  std::function<void()> between{};
};

/// Carries out these runs of the plan, the longest first, `jobs` at a time (0: one for each core), and puts the results
/// into the store. No batch begins once no_more is set, which an exception does as well; finished runs are kept.
/// Returns the numbers of the runs that were committed. Rethrows exceptions of `work` and of the store.
std::vector<std::uint32_t> run_all(const std::string& name, const Plan& plan, const std::vector<std::uint32_t>& runs,
                                   const Work& work, int jobs, Store& store, std::atomic<bool>& no_more);

}  // namespace polhode::study::workers
