// SPDX-License-Identifier: BSD-3-Clause
// Text in a picture: each run's method and time, the names of arrows, and why a run stands still.
#pragma once

#include <vector>

#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline overlay {

/// Behind all windows of Dear ImGui; `area` is where the runs were drawn.
void write_captions(Stage& stage, const std::vector<Label>& labels, const Rectangle& area, int picture_height);

}  // namespace polhode::viewer
