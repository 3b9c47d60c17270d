// SPDX-License-Identifier: BSD-3-Clause
// A finished study: the input of the writers of tables, figures and reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/plot/figure_choice.hpp"
#include "experiments/study/record/analysis.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline record {

struct StudyView {
  std::string experiment;                ///< "energy_drift"
  std::string question;                  ///< the experiment's question in one sentence
  std::string command;                   ///< the command line that reproduces this study
  std::vector<Scenario> scenarios;       ///< each scenario of the study once, without overrides
  std::vector<std::string> varied_keys;  ///< scenario keys that are axes
  NamedOptions named{};                  ///< options on demand that the study gives
  std::vector<std::string> invariants;   ///< names of further declared invariants, sorted: columns of runs.csv
  std::vector<RunRecord> runs;           ///< sorted by configuration: the order of runs.csv
  /// Number of all runs by status, if `runs` are a sample of a study that is too large to be held; else empty.
  std::map<std::string, std::size_t> all_runs{};
  std::filesystem::path folder;         ///< results folder (--out)
  bool durations_follow_steps = false;  ///< the duration of a run depends on its step
  FigureChoice figure_choice{};
  std::optional<Analysis> analysis{};  ///< results of the experiment's own analysis
  std::span<const Metric> metrics = metric_table();

  /// Number of all runs.
  std::size_t size() const {
    std::size_t n = all_runs.empty() ? runs.size() : 0;
    for (const auto& [status, count] : all_runs) n += count;
    return n;
  }
};

}  // namespace polhode::study::record
