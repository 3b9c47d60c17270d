// SPDX-License-Identifier: BSD-3-Clause
// Errors of impacts: their energy, the momenta and the time of the first, against the step.
#pragma once

#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::impact {

/// For each motion a run that stands for the exact one up to its first impact: located impacts, a method of order 8 and
/// a tolerance at round-off.
std::vector<RunConfig> exact_impacts(const StudyView& study);

Analysis errors_of_impacts(const StudyView& study);

}  // namespace polhode::study
