// SPDX-License-Identifier: BSD-3-Clause
// The openings of joints, the cost of keeping them closed, and the errors of their reactions.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::joints {

/// The analysis, for each scenario, method and stabilization against the right-hand sides.
Analysis how_joints_hold(const StudyView& study);

}  // namespace polhode::study::joints
