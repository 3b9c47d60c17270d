// SPDX-License-Identifier: BSD-3-Clause
// An OpenGL context without a window, for pictures on machines without a display.
#pragma once

#include <memory>

#include "experiments/viewer/pictures/picture.hpp"

namespace polhode::viewer::inline pictures {

/// True if the current context renders in software: the cost is then proportional to the samples for each pixel.
bool draws_in_software();

/// OpenGL 3.3 core by EGL: Mesa's surfaceless platform if available, else the first device, else the default display.
/// The context is current in the thread that created it.
class Offscreen {
 public:
  /// `samples` for each pixel; 1: no multisampling. Throws std::runtime_error (one line) with the remedy.
  Offscreen(int width, int height, int samples);
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;
  ~Offscreen();

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  /// Name of the renderer, as the driver gives it.
  const char* driver() const;

  /// Binds this picture as the target of all drawing.
  void bind();
  /// The picture drawn so far.
  Picture read();

 private:
  struct Context;
  struct Target;
  std::unique_ptr<Context> context_;
  std::unique_ptr<Target> drawn_, resolved_;
  int width_, height_, samples_;
};

}  // namespace polhode::viewer::pictures
