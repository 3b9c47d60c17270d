// SPDX-License-Identifier: BSD-3-Clause
// The two ways to see a stage: in a window, or as pictures without one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer {

/// What is shown at first.
struct Shown {
  bool axes = false, angular_velocity = false, angular_momentum = false, trails = true, polhode = false,
       poinsot = false, contacts = true, cells = false;
  std::optional<double> azimuth, elevation;  ///< rad; absent: as the scene asks for
  double zoom = 1;                           ///< so many times as near
};
void show(const Shown& shown, Stage& stage);

struct WindowSettings {
  int width = 1280, height = 720;
  std::optional<int> samples;  ///< a pixel; absent: 4, or 1 where the processor draws
  bool play = false;
  double speed = 1;
  std::filesystem::path script;  ///< empty: none
  std::filesystem::path out;     ///< of pictures
  Shown shown;
};
/// Until it is closed. Throws std::runtime_error in one line where there is no display.
void show_window(StageSetup setup, const WindowSettings& settings);

struct OffscreenSettings {
  int width = 1280, height = 720, samples = 4;
  std::filesystem::path out;   ///< folder of frame_0001.png and so on
  std::filesystem::path film;  ///< empty: none
  bool frames = true;          ///< as PNG files
  int frames_per_second = 30;
  double speed = 1;                 ///< simulated seconds to one of the film
  std::optional<double> from;       ///< s: the first picture
  std::optional<double> duration;   ///< s of simulated time; 0: one picture
  bool pause_on_collision = false;  ///< the last picture is of the first collision
  bool captions = true;
  bool plots = false;
  Shown shown;
};
/// Returns how many pictures there are. Throws std::runtime_error in one line.
int show_offscreen(StageSetup setup, const OffscreenSettings& settings);

}  // namespace polhode::viewer
