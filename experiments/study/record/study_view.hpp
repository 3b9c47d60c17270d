// SPDX-License-Identifier: BSD-3-Clause
// What the writers of tables, figures and reports see of a finished study.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/record/analysis.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study {

struct StudyView {
  std::string experiment;                ///< "energy_drift"
  std::string question;                  ///< the experiment's question in one sentence
  std::string command;                   ///< the command line that makes this study again
  std::vector<Scenario> scenarios;       ///< each scenario of the study once, without overrides
  std::vector<std::string> varied_keys;  ///< scenario keys that are axes
  NamedOptions named{};
  std::vector<std::string> invariants;  ///< names of further declared invariants, sorted: columns of runs.csv
  std::vector<RunRecord> runs;          ///< sorted by configuration, the order of runs.csv
  std::filesystem::path folder;         ///< --out
  bool durations_follow_steps = false;  ///< runs of one curve last as long as their step has it
  std::optional<Analysis> analysis{};   ///< the experiment's own
};

/// figures/: SVG and PDF by gnuplot with the .gp script and the data beside each, and a PGFPlots .tex; timings/
/// likewise for what the analysis made from wall times. Throws std::runtime_error when gnuplot fails; where gnuplot is
/// not installed the scripts and data are still written and the returned text says so (empty: all made).
std::string write_figures(const StudyView& study);

/// tables/: LaTeX (booktabs), Markdown, and \newcommand values; the files of the analysis.
void write_tables(const StudyView& study);

/// report.html: opens alone, without a network; says in words what was run and what is seen in it.
void write_report(const StudyView& study);

}  // namespace polhode::study
