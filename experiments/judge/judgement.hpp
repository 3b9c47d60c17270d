// SPDX-License-Identifier: BSD-3-Clause
// Report of judge about its scores: the table, scores.csv, the figure of errors against time, and the findings.
#pragma once

#include <vector>

#include "experiments/judge/first_line.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::judge {

/// The analysis. judged: one entry for each run of the study, in the same order. The first sentences of the analysis
/// are the first lines of the trajectories.
Analysis judgement(const StudyView& study, const std::vector<Judged>& judged);

}  // namespace polhode::study::judge
