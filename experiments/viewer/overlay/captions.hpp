// SPDX-License-Identifier: BSD-3-Clause
// Texts in a picture: method and time of each run, names of arrows, and the reason why a run stopped.
#pragma once

#include <vector>

#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline overlay {

/// Draws the texts behind all windows of Dear ImGui; `area` is the rectangle in which the runs were drawn.
void write_captions(Stage& stage, const std::vector<Label>& labels, const Rectangle& area, int picture_height);

}  // namespace polhode::viewer::overlay
