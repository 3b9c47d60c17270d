// SPDX-License-Identifier: BSD-3-Clause
// The true error of every run against what it cost, and the lower envelope of each motion's curves.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::work_precision {

/// Against right-hand sides; and, apart from what must be the same bytes at every call, against wall time. A motion's
/// error is that of the attitude, where it has none of the position.
Analysis work_against_error(const StudyView& study);

}  // namespace polhode::study
