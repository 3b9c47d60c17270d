// SPDX-License-Identifier: BSD-3-Clause
// The controls: time, what is shown, and by what each run moves.
#pragma once

#include <optional>
#include <string>

#include "experiments/viewer/overlay/gui.hpp"
#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline overlay {

/// What the controls ask of the window, which alone can do it.
struct PanelWishes {
  std::optional<std::string> scenario;  ///< another one
  bool picture = false;                 ///< of what is seen now
  bool camera = false;                  ///< back to where it first was
};

class Panel {
 public:
  /// At the left edge, so wide (pixels) and so high.
  PanelWishes draw(Stage& stage, Controls& controls, float width, float height);

 private:
  void time(Stage& stage, Controls& controls);
  void runs(Stage& stage, Controls& controls);
  void method(Stage& stage, Controls& controls);
  void shown(Stage& stage, Controls& controls);
  void numbers(Stage& stage);
  void change(Stage& stage, const Configuration& configuration);

  std::size_t run_ = 0;  ///< whose method is shown
  double speed_ = 1;     ///< of all runs, as they say it
  bool pause_on_collision_ = false;
  std::string refused_;  ///< why the last change was not made
};

}  // namespace polhode::viewer
