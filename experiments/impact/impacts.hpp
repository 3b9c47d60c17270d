// SPDX-License-Identifier: BSD-3-Clause
// Errors of impacts against the step: energy, momenta, and the time of the first impact.
#pragma once

#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::impact {

/// For each motion, a run that replaces the exact solution up to the first impact: impacts located in time, a method of
/// order 8, and a tolerance at round-off.
std::vector<RunConfig> exact_impacts(const StudyView& study);

/// The analysis: errors of energy, momenta and first impact time against the step.
Analysis errors_of_impacts(const StudyView& study);

}  // namespace polhode::study::impact
