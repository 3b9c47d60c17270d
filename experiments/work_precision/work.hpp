// SPDX-License-Identifier: BSD-3-Clause
// True error of every run against its cost, and the lower envelope of the curves of each motion.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::work_precision {

/// The analysis: error against evaluations of the right-hand side and, in Analysis::timed, against wall time. The error
/// is that of the attitude or, for a motion without one, that of the position.
Analysis work_against_error(const StudyView& study);

}  // namespace polhode::study::work_precision
