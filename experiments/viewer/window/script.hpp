// SPDX-License-Identifier: BSD-3-Clause
// A scripted session: lines that move the mouse and press keys as a user would, look at what comes of it, and take
// pictures. For tests, and for pictures that can be made again.
//
//   click play                 the control of that name (as in Controls)
//   choose integrator heun     opens a list and takes an item
//   drag time 0.25             presses at that share of a slider's width
//   type dt 0.01               into a field, with Enter
//   wait 10                    frames
//   until t 1.5                frames, until it is at least so; also `until paused`
//   expect integrator heun     else the script fails; see Script::value() for what can be asked
//   expect t < 0.5
//   pull 100 -30               with the left button, so many pixels right and down, in the middle of the runs
//   key space                  space, right, home
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
  /// Throws InputError with the line.
  Script(const std::string& file, FileMaker take_picture, FileMaker write_places);

  /// Where the runs are: pixels from the window's left and upper edge.
  void set_view(float middle_x, float middle_y) { view_x_ = middle_x, view_y_ = middle_y; }

  /// Before a frame of Dear ImGui: what mouse and keyboard do in it.
  void before_frame();
  /// After a frame. Throws InputError with the line where an expectation does not hold or a control is not there.
  void after_frame(Stage& stage, Controls& controls);
  bool done() const { return lines_.empty() && inputs_.empty(); }

 private:
  struct Line {
    int number;
    std::vector<std::string> words;
  };
  /// What one frame sees of mouse and keyboard.
  struct Input {
    float x = 0, y = 0;
    bool pressed = false;
    int key = 0;  ///< as GLFW numbers them; 0: none
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
  std::string opened_;  ///< the item to be taken from a list that is open
  FileMaker take_picture_, write_places_;
};

}  // namespace polhode::viewer
