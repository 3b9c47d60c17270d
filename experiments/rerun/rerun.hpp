// SPDX-License-Identifier: BSD-3-Clause
// Carries out stored runs again and compares the results.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/rerun/comparison.hpp"
#include "experiments/study/query/result_stores.hpp"

namespace polhode::study::rerun {

/// The outcome of one run that was to be repeated.
struct Repeated {
  FoundRun run;
  std::string why_not;                  ///< reason for which it was not repeated; empty: it was
  std::string words;                    ///< scenario, method and step or tolerance
  std::vector<Difference> differences;  ///< numbers that differ; empty: none
};

/// Repeats the runs, `jobs` at a time (0: one for each core), each alone in its thread, and calls done(result) for each
/// in the order of `runs`, one at a time, as soon as it and those before it have ended. No run begins once `no_more` is
/// set; `stop` ends those under way, which are left out.
void repeat(const std::vector<FoundRun>& runs, int jobs, const std::atomic<bool>& no_more,
            const std::atomic<bool>& stop, const std::function<void(const Repeated&)>& done);

/// All runs of the stores once, in the order of their ids.
std::vector<FoundRun> all_runs(const ResultStores& stores);
/// Runs drawn at random without repetition, in the order of their ids; all if there are not more than `number`.
std::vector<FoundRun> drawn(std::vector<FoundRun> runs, std::size_t number, std::uint64_t seed);

}  // namespace polhode::study::rerun
