// SPDX-License-Identifier: BSD-3-Clause
// Carries out runs: puts system, method and meter together and says what came out.
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

/// Why this run makes no sense, in one line; empty if it does. Throws std::invalid_argument on an impossible step.
std::string refusal(const RunConfig& config, const Scenario& scenario);

struct TrajectoryRequest {
  TrajectoryFormat format = TrajectoryFormat::none;
  std::filesystem::path folder;
  /// If set, its observer replaces the files.
  std::function<std::unique_ptr<TrajectoryWriter>(const System<double>&)> open{};
};

/// What is thrown out of the run is its failure, and its message says why; throws TrajectoryError alone, when a
/// trajectory cannot be written. All numbers of the result are finite. A run stopped from outside has the status
/// "interrupted" and must not be kept. `references`: where the runs of a study share them; null: a run that asks for
/// one makes its own.
RunResult carry_out(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory,
                    const std::atomic<bool>* stop, References* references = nullptr);

/// Runs of the same non-empty key differ in initial values and parameters alone and can go side by side in the lanes of
/// an ensemble. Empty: the run goes alone.
std::string ensemble_key(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory);

struct LanedRun {
  const RunConfig& config;
  const Scenario& scenario;
};
/// At most lane_count runs of one key, together, with the digits that carry_out() gives to each; the time is shared
/// out. Where that throws, each goes alone, so that only those fail which do so by themselves.
std::vector<RunResult> carry_out_together(std::span<const LanedRun> runs, const std::atomic<bool>* stop,
                                          References* references = nullptr);

}  // namespace polhode::study
