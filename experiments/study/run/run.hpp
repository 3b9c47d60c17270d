// SPDX-License-Identifier: BSD-3-Clause
// Carries out runs: combines system, method and meters, and returns the results.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/trajectory/trajectory.hpp"

namespace polhode::study::inline run {

/// Reason, in one line, why a run makes no sense; empty if it does. Throws std::invalid_argument for an impossible
/// step.
std::string refusal(const RunConfig& config, const Scenario& scenario);

struct TrajectoryRequest {
  TrajectoryFormat format = TrajectoryFormat::none;
  std::filesystem::path folder;
  /// If set, its observer replaces the files.
  std::function<std::unique_ptr<TrajectoryWriter>(const System<double>&)> open{};
};

/// Carries out one run. Exceptions from the run become its failure, with their message; only TrajectoryError is
/// rethrown. All numbers of the result are finite. A run stopped from outside has the status "interrupted" and must not
/// be stored. `references`: the references shared by the runs of a study; null: the run computes its own if it needs
/// one. `share`: gets the part of the duration that is done, 0 to 1, if it is not null.
RunResult carry_out(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory,
                    const std::atomic<bool>* stop, References* references = nullptr,
                    std::atomic<double>* share = nullptr);

/// Runs with the same non-empty key differ only in initial values, parameters, steps and duration and can share the
/// lanes of an ensemble. Empty: the run is carried out alone.
std::string ensemble_key(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory);

struct LanedRun {
  const RunConfig& config;
  const Scenario& scenario;
  bool keeps_curves = true;  ///< the result has the curves against time
};
/// Runs of one key that are carried out together.
struct LanedWork {
  std::span<const LanedRun> runs;
  /// Receives the result of a run when it has ended. A run that was stopped has the status "interrupted".
  std::function<void(std::size_t run, RunResult&& result)> finish;
  const std::atomic<bool>* stop = nullptr;     ///< ends the runs under way
  const std::atomic<bool>* no_more = nullptr;  ///< no further run begins
  References* references = nullptr;            ///< references, the same as in carry_out()
  std::atomic<double>* share = nullptr;        ///< gets the part of all steps that is done, 0 to 1
};
/// Carries out runs in the lanes of an ensemble, with the digits that carry_out() gives to each. The lane of a run that
/// has ended passes to the next one. The time is divided among the runs under way. If that throws, the runs that are
/// left are carried out alone, so that only those fail that fail by themselves.
void carry_out_together(const LanedWork& work);

}  // namespace polhode::study::run
