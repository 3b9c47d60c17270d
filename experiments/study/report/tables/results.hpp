// SPDX-License-Identifier: BSD-3-Clause
// The tables that a study leaves for other programs: runs.csv, timings.csv and manifest.json.
#pragma once

#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

/// One row per run, sorted by configuration, no timings: the same bytes however the study was run.
void write_runs_csv(const StudyView& study);

/// Wall time of each run, apart from the results.
void write_timings_csv(const StudyView& study);

/// What was run and with what: configuration, versions, commit, compiler, flags, processor, seed.
void write_manifest(const StudyView& study, const Options& options, const Plan& plan);

}  // namespace polhode::study
