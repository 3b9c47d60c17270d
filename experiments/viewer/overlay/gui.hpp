// SPDX-License-Identifier: BSD-3-Clause
// Dear ImGui over OpenGL, with or without a window: text and controls on top of what was drawn, and where each control
// is, so that a script finds it.
#pragma once

#include <map>
#include <string>

struct ImVec2;

namespace polhode::viewer::inline overlay {

/// Where the controls of a frame are, by name: "play", "integrator", and "integrator/rk4" while that list is open.
class Controls {
 public:
  struct Place {
    float left = 0, upper = 0, right = 0, lower = 0;  ///< pixels
  };

  void begin_frame() { places_.clear(); }
  /// The control drawn last has this name.
  void named(const std::string& name);
  /// The same of one with a field of the usual width, and text behind it that does not belong to it.
  void field_named(const std::string& name);
  const Place* find(const std::string& name) const;

  std::string reveal;  ///< an item of an open list that is to be scrolled to

 private:
  std::map<std::string, Place> places_;
};

/// One at a time; wants a current context of OpenGL.
class Gui {
 public:
  Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  ~Gui();

  /// Without a window: size and time of the frame that begins. With one, its backend tells them.
  void begin_offscreen(int width, int height, double seconds);
  void draw();

  Controls controls;
};

}  // namespace polhode::viewer
