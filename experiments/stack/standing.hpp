// SPDX-License-Identifier: BSD-3-Clause
// How long stacks stand, how deep their boxes sink into each other, and what becomes of the energy.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::stack {

/// Against the number of moving bodies, for each step and response.
Analysis how_stacks_stand(const StudyView& study);

}  // namespace polhode::study
