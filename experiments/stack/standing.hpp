// SPDX-License-Identifier: BSD-3-Clause
// Time for which stacks of boxes stand, penetration depth, and energy.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::stack {

/// The analysis, against the number of moving bodies for each step and response.
Analysis how_stacks_stand(const StudyView& study);

}  // namespace polhode::study::stack
