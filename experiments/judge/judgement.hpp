// SPDX-License-Identifier: BSD-3-Clause
// What judge makes of its scores: the table, scores.csv, the figure of the errors against time, and what is seen.
#pragma once

#include <vector>

#include "experiments/study/study_view.hpp"
#include "experiments/study/trajectory_score.hpp"

namespace polhode::study {

/// The scores in the order of the runs of the study.
Analysis judgement(const StudyView& study, const std::vector<TrajectoryScore>& scores);

}  // namespace polhode::study
