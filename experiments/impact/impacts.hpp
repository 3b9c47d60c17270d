// SPDX-License-Identifier: BSD-3-Clause
// Errors of impacts against the step: energy, momenta, and the time of the first impact.
#pragma once

#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::impact {

/// Runs that replace the exact solution of each motion up to its first impact. Their impacts are located in time, the
/// method has order 8, and the tolerance is at round-off.
std::vector<RunConfig> exact_impacts(const StudyView& study);

/// The analysis: errors of energy, momenta and first impact time against the step.
Analysis errors_of_impacts(const StudyView& study);

}  // namespace polhode::study::impact
