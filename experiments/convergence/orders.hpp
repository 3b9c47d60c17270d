// SPDX-License-Identifier: BSD-3-Clause
// The observed order of every curve of a study beside the declared one.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::convergence {

/// Of fixed-step methods: the error against the step. Of adaptive ones: against the tolerance, to which it should be
/// proportional.
Analysis observed_orders(const StudyView& study);

}  // namespace polhode::study
