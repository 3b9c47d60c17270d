// SPDX-License-Identifier: BSD-3-Clause
// Results of a study for other programs: runs.csv, timings.csv and manifest.json.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline report::inline tables {

/// Writes runs.csv, some rows at a time.
class RunsCsv {
 public:
  /// `study`: all of it, or a sample of its runs. Throws WriteError, as the other members do.
  explicit RunsCsv(const StudyView& study);
  /// Appends the row of a run to the rows. `cells`: those of the run below config_columns(). Thread-safe.
  void write(const RunRecord& run, const std::vector<std::string>& cells, std::string& rows) const;
  void add(const std::string& rows) { file_.add(rows); }
  void finish() { file_.finish(); }

 private:
  std::vector<const Metric*> metrics_;
  std::vector<std::string> invariants_;
  TextFile file_;
};

/// Writes timings.csv, some rows at a time.
class TimingsCsv {
 public:
  explicit TimingsCsv(const StudyView& study);
  /// Appends the row of a run to the rows.
  static void write(const RunRecord& run, std::string& rows);
  void add(const std::string& rows) { file_.add(rows); }
  void finish() { file_.finish(); }

 private:
  TextFile file_;
};

/// Writes runs.csv: one row per run, sorted by configuration, without timings. Deterministic: the same bytes for the
/// same study, whatever the number of jobs or interruptions.
void write_runs_csv(const StudyView& study);

/// Writes timings.csv: the wall time of each run, separate from the results.
void write_timings_csv(const StudyView& study);

/// Writes manifest.json: configuration, versions, commit, compiler, flags, processor, seed.
void write_manifest(const StudyView& study, const Options& options, const Plan& plan);

}  // namespace polhode::study::report::tables
