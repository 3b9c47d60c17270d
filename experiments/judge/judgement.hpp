// SPDX-License-Identifier: BSD-3-Clause
// What judge makes of its scores: the table, scores.csv, the figure of the errors against time, and what is seen.
#pragma once

#include <vector>

#include "experiments/judge/first_line.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::judge {

/// The trajectories in the order of the runs of the study. Its first sentences are their first lines.
Analysis judgement(const StudyView& study, const std::vector<Judged>& judged);

}  // namespace polhode::study
