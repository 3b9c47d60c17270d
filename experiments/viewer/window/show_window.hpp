// SPDX-License-Identifier: BSD-3-Clause
// Shows a stage in a window.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/viewer/stage/show.hpp"

namespace polhode::viewer::inline window {

struct WindowSettings {
  int width = 1280, height = 720;
  std::optional<int> samples;  ///< samples for each pixel; absent: 4, or 1 with a software renderer
  bool play = false;
  double speed = 1;
  std::filesystem::path script;  ///< script; empty: none
  std::filesystem::path out;     ///< folder for pictures
  Shown shown;
};
/// Returns when the window is closed. Throws std::runtime_error (one line) if there is no display.
void show_window(StageSetup setup, const WindowSettings& settings);

}  // namespace polhode::viewer::window
