// SPDX-License-Identifier: BSD-3-Clause
// The controls: time, visible marks, and the method of each run.
#pragma once

#include <optional>
#include <string>

#include "experiments/viewer/overlay/gui.hpp"
#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline overlay {

/// Requests of the controls that only the window can carry out.
struct PanelWishes {
  std::optional<std::string> scenario;  ///< open another scenario
  bool picture = false;                 ///< save a picture of the present view
  bool camera = false;                  ///< reset the camera
};

/// The value of a run option by the name of its control; "true" or "false" for a check box, "none" for an empty field
/// and for an option that does not apply. Absent if no run option has such a control.
std::optional<std::string> option_text(const study::RunConfig& run, const std::string& name);

class Panel {
 public:
  /// Draws the panel at the left edge; width and height in pixels.
  PanelWishes draw(Stage& stage, Controls& controls, float width, float height);

 private:
  void time(Stage& stage, Controls& controls);
  void runs(Stage& stage, Controls& controls);
  void method(Stage& stage, Controls& controls);
  void options(Stage& stage, Controls& controls, Configuration& configuration);
  void shown(Stage& stage, Controls& controls);
  void numbers(Stage& stage);
  void change(Stage& stage, const Configuration& configuration);

  std::size_t run_ = 0;  ///< the run whose method is shown
  double speed_ = 1;     ///< speed of all runs
  bool pause_on_collision_ = false;
  std::string refused_;  ///< reason why the last change was refused
};

}  // namespace polhode::viewer::overlay
