// SPDX-License-Identifier: BSD-3-Clause
// Analysis of the experiment `stability`: critical steps, their values by linear theory, and maps.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::stability {

Analysis stability(const StudyView& study);

}  // namespace polhode::study::stability
