// SPDX-License-Identifier: BSD-3-Clause
// An OpenGL context without a window, to draw pictures where there is no display.
#pragma once

#include <memory>

#include "experiments/viewer/pictures/picture.hpp"

namespace polhode::viewer::inline pictures {

/// Whether the current context draws by the processor: a sample more a pixel then costs as much as the first.
bool draws_in_software();

/// OpenGL 3.3 core by EGL: Mesa's surfaceless platform where there is one, else the first device, else the usual
/// display. The context is current in the thread that made it.
class Offscreen {
 public:
  /// `samples` a pixel; 1: no multisampling. Throws std::runtime_error in one line with the remedy.
  Offscreen(int width, int height, int samples);
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;
  ~Offscreen();

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  /// What draws, as the driver names it.
  const char* driver() const;

  /// What is drawn from now on goes into this picture.
  void bind();
  /// The picture as drawn so far.
  Picture read();

 private:
  struct Context;
  struct Target;
  std::unique_ptr<Context> context_;
  std::unique_ptr<Target> drawn_, resolved_;
  int width_, height_, samples_;
};

}  // namespace polhode::viewer
