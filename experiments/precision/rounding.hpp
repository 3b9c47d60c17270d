// SPDX-License-Identifier: BSD-3-Clause
// Separation of rounding errors from truncation errors by runs that differ only in the arithmetic.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::precision {

Analysis rounding_and_truncation(const StudyView& study);

}  // namespace polhode::study::precision
