// SPDX-License-Identifier: BSD-3-Clause
// Renders a stage to pictures, without a window.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/viewer/stage/show.hpp"

namespace polhode::viewer::inline pictures {

struct OffscreenSettings {
  int width = 1280, height = 720, samples = 4;
  std::filesystem::path out;   ///< folder for frame_0001.png and so on
  std::filesystem::path film;  ///< file of the film; empty: none
  bool frames = true;          ///< write PNG files
  int frames_per_second = 30;
  double speed = 1;                 ///< simulated seconds for each second of the film
  std::optional<double> from;       ///< simulated time of the first picture, s
  std::optional<double> duration;   ///< simulated duration, s; 0: one picture
  bool pause_on_collision = false;  ///< the last picture is that of the first collision
  bool captions = true;
  bool plots = false;
  Shown shown;
};
/// Returns the number of pictures. Throws std::runtime_error (one line).
int show_offscreen(StageSetup setup, const OffscreenSettings& settings);

}  // namespace polhode::viewer::pictures
