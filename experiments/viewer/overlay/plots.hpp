// SPDX-License-Identifier: BSD-3-Clause
// Live plots of energy, momentum and orientation defect against time.
#pragma once

#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline overlay {

/// A strip of plots at the lower edge of the picture, one curve for each run.
void draw_plots(Stage& stage, float left, float upper, float width, float height);

}  // namespace polhode::viewer::overlay
