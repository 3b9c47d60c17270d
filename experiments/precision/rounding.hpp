// SPDX-License-Identifier: BSD-3-Clause
// Rounding told from truncation, by runs that differ in nothing but the arithmetic.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::precision {

Analysis rounding_and_truncation(const StudyView& study);

}  // namespace polhode::study
