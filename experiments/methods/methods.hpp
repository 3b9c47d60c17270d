// SPDX-License-Identifier: BSD-3-Clause
// Analysis of the experiment `methods`: which method to take for which kind of problem, and how far that holds.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::methods {

Analysis comparison(const StudyView& study);

}  // namespace polhode::study::methods
