// SPDX-License-Identifier: BSD-3-Clause
// How far joints open, what that costs, and how right their reactions are.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::joints {

/// The analysis, for each scenario, method and stabilization against the right-hand sides.
Analysis how_joints_hold(const StudyView& study);

}  // namespace polhode::study::joints
