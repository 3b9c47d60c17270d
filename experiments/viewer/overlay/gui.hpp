// SPDX-License-Identifier: BSD-3-Clause
// Dear ImGui over OpenGL, with or without a window: text and controls on top of the picture, and the places of the
// controls, for scripts.
#pragma once

#include <map>
#include <string>

struct ImVec2;

namespace polhode::viewer::inline overlay {

/// Places of the controls of a frame, by name: "play", "integrator", and "integrator/rk4" while that list is open.
class Controls {
 public:
  struct Place {
    float left = 0, upper = 0, right = 0, lower = 0;  ///< pixels
  };

  void begin_frame() { places_.clear(); }
  /// Names the control drawn last.
  void named(const std::string& name);
  /// Names the control drawn last, if it is a field of the usual width followed by text that is not part of it.
  void field_named(const std::string& name);
  const Place* find(const std::string& name) const;

  std::string reveal;  ///< an item of an open list to scroll to

 private:
  std::map<std::string, Place> places_;
};

/// The context of Dear ImGui; at most one at a time. Needs a current OpenGL context.
class Gui {
 public:
  Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  ~Gui();

  /// Size and time of the frame that begins, without a window; with one, its backend sets them.
  void begin_offscreen(int width, int height, double seconds);
  void draw();

  Controls controls;
};

}  // namespace polhode::viewer::overlay
