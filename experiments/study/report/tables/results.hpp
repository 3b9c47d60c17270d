// SPDX-License-Identifier: BSD-3-Clause
// Results of a study for other programs: runs.csv, timings.csv and manifest.json.
#pragma once

#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

/// Writes runs.csv: one row per run, sorted by configuration, without timings. Deterministic: the same bytes for the
/// same study, whatever the number of jobs or interruptions.
void write_runs_csv(const StudyView& study);

/// Writes timings.csv: the wall time of each run, separate from the results.
void write_timings_csv(const StudyView& study);

/// Writes manifest.json: configuration, versions, commit, compiler, flags, processor, seed.
void write_manifest(const StudyView& study, const Options& options, const Plan& plan);

}  // namespace polhode::study::report::tables
