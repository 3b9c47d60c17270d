// SPDX-License-Identifier: BSD-3-Clause
// What the experiment `stability` makes of its runs: critical steps, linear theory beside them, and maps.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::stability {

Analysis stability(const StudyView& study);

}  // namespace polhode::study
