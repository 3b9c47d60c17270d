// SPDX-License-Identifier: BSD-3-Clause
// Observed order of every curve of a study, compared with the declared order.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::convergence {

/// Orders of the error in the step (fixed-step methods) or in the tolerance (adaptive methods, whose error should be
/// proportional to it).
Analysis observed_orders(const StudyView& study);

}  // namespace polhode::study::convergence
