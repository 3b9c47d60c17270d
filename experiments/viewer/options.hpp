// SPDX-License-Identifier: BSD-3-Clause
// The viewer's command line.
#pragma once

#include <optional>
#include <string>

#include "experiments/viewer/pictures/show_offscreen.hpp"
#include "experiments/viewer/window/show_window.hpp"

namespace polhode::viewer {

struct Options {
  std::optional<int> exit_status;   ///< the program is done: help was printed, or the line is wrong
  std::optional<std::string> list;  ///< value of --list
  std::string rerun;                ///< a recorded session; empty: none
  bool offscreen = false;
  StageSetup stage;
  WindowSettings window;
  OffscreenSettings pictures;
};

/// Throws InputError.
Options parse(const std::string& question, int argc, const char* const* argv);

}  // namespace polhode::viewer
