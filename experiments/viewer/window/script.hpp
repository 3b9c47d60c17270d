// SPDX-License-Identifier: BSD-3-Clause
// A scripted session: lines that move the mouse and press keys like a user, check the result, and save pictures. For
// tests, and for pictures that can be reproduced.
//
//   click play                 the control of that name (as in Controls)
//   choose integrator heun     opens a list and takes an item
//   drag time 0.25             presses at that share of a slider's width
//   type dt 0.01               into a field, with Enter
//   wait 10                    frames
//   until t 1.5                frames, until it is at least so; also `until paused`
//   expect integrator heun     else the script fails; Script::value() lists the values that can be tested
//   expect t < 0.5
//   pull 100 -30               with the left button, so many pixels right and down, in the middle of the runs
//   key space                  space, right, home, j, r
//   picture FILE
//   places FILE                CSV: run, body, the pixel where its mass centre is in the picture, and its colour
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "experiments/viewer/overlay/gui.hpp"
#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline window {

class Script {
 public:
  using FileMaker = std::function<void(const std::string&)>;
  /// Reads a script. Throws InputError with the line.
  Script(const std::string& file, FileMaker take_picture, FileMaker write_places);

  /// The rectangle of the runs: pixels from the left and upper edge of the window.
  void set_view(float middle_x, float middle_y) { view_x_ = middle_x, view_y_ = middle_y; }

  /// Sends mouse and keyboard input to Dear ImGui; call before a frame.
  void before_frame();
  /// Evaluates the frame; call after it. Throws InputError with the line if an expectation fails or a control is
  /// missing.
  void after_frame(Stage& stage, Controls& controls);
  bool done() const { return lines_.empty() && inputs_.empty(); }

 private:
  struct Line {
    int number;
    std::vector<std::string> words;
  };
  /// Mouse and keyboard input of one frame.
  struct Input {
    float x = 0, y = 0;
    bool pressed = false;
    int key = 0;  ///< GLFW's key code; 0: none
    std::string typed{};
  };

  [[noreturn]] void fail(const std::string& why) const;
  double number(const std::string& word) const;
  void take(Stage& stage, Controls& controls);
  void click(const Controls& controls, const std::string& name, float share = 0.5F);
  std::string value(Stage& stage, const std::string& of) const;
  bool holds(Stage& stage, const std::vector<std::string>& words) const;

  std::string file_;
  std::deque<Line> lines_;
  std::deque<Input> inputs_;
  Input now_;
  float view_x_ = 0, view_y_ = 0;
  Line line_{};
  int waited_ = 0;
  std::string opened_;  ///< the item to choose in an open list
  FileMaker take_picture_, write_places_;
};

}  // namespace polhode::viewer::window
