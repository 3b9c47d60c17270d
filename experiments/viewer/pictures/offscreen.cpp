// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/pictures/offscreen.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace polhode::viewer::inline pictures {

namespace {

constexpr const char* remedy = "install libegl1 and libgl1-mesa-dri (Mesa's software renderer needs no graphics card)";

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(fmt::format("cannot draw without a display: {}; {}", what, remedy));
}

/// The first display that can be initialised; those without a window system are tried first.
EGLDisplay find_display() {
  const auto usable = [](EGLDisplay display) {
    return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
  };
  const auto has = [](const char* name) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, name); };
  if (has("EGL_EXT_platform_base")) {
    if (has("EGL_MESA_platform_surfaceless")) {
      const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
      if (usable(display)) return display;
    }
    if (has("EGL_EXT_platform_device") && has("EGL_EXT_device_enumeration")) {
      std::array<EGLDeviceEXT, 8> devices{};
      EGLint count = 0;
      if (eglQueryDevicesEXT(int(devices.size()), devices.data(), &count) != EGL_TRUE) count = 0;
      for (EGLint i = 0; i < count; ++i) {
        const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[std::size_t(i)], nullptr);
        if (usable(display)) return display;
      }
    }
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  return usable(display) ? display : EGL_NO_DISPLAY;
}

}  // namespace

struct Offscreen::Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  Context() {
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // errors are reported once, by the exception
    display = find_display();
    if (display == EGL_NO_DISPLAY) fail("EGL offers no display");
    try {
      make();
    } catch (...) {
      end();
      throw;
    }
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { end(); }

 private:
  void make() {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("this EGL knows no desktop OpenGL");
    const std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                          EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) {
      fail("EGL offers no configuration for OpenGL");
    }
    const std::array<EGLint, 7> version = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    if (context == EGL_NO_CONTEXT) fail("there is no OpenGL 3.3 core context");
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
      const std::array<EGLint, 5> one_pixel = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
      surface = eglCreatePbufferSurface(display, config, one_pixel.data());
    }
    if (eglMakeCurrent(display, surface, surface, context) != EGL_TRUE) fail("the context cannot be made current");
  }

  /// The display stays initialised: the whole program shares it, and other contexts may use it.
  void end() {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
  }
};

/// A framebuffer with colour, depth and stencil.
struct Offscreen::Target {
  GLuint framebuffer = 0, colour = 0, depth = 0;

  Target(int width, int height, int samples) {
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    colour = attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, width, height, samples);
    depth = attach(GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8, width, height, samples);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw std::runtime_error(fmt::format(
          "cannot draw a picture of {}×{} pixels with {} samples each: choose a smaller one", width, height, samples));
    }
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  ~Target() {
    glDeleteRenderbuffers(1, &colour);
    glDeleteRenderbuffers(1, &depth);
    glDeleteFramebuffers(1, &framebuffer);
  }

 private:
  static GLuint attach(GLenum place, GLenum format, int width, int height, int samples) {
    GLuint buffer = 0;
    glGenRenderbuffers(1, &buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
    return buffer;
  }
};

Offscreen::Offscreen(int width, int height, int samples) : width_(width), height_(height), samples_(samples) {
  context_ = std::make_unique<Context>();
  GLint most = 1, largest = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width < 1 || height < 1 || width > largest || height > largest) {
    throw std::runtime_error(
        fmt::format("cannot draw a picture of {}×{} pixels: each edge is 1 to {}", width, height, largest));
  }
  samples_ = std::clamp(samples, 1, std::max(most, 1));
  drawn_ = std::make_unique<Target>(width, height, samples_);
  if (samples_ > 1) resolved_ = std::make_unique<Target>(width, height, 1);
  bind();
}

Offscreen::~Offscreen() = default;

const char* Offscreen::driver() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

bool draws_in_software() {
  const std::string driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return driver.find("llvmpipe") != std::string::npos || driver.find("softpipe") != std::string::npos;
}

void Offscreen::bind() {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_->framebuffer);
  glViewport(0, 0, width_, height_);
}

Picture Offscreen::read() {
  if (resolved_) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_->framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_->framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_ ? resolved_->framebuffer : drawn_->framebuffer);
  const std::size_t row = 3 * std::size_t(width_);
  Picture picture{width_, height_, std::vector<std::uint8_t>(row * std::size_t(height_))};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
  for (std::size_t upper = 0, lower = std::size_t(height_) - 1; upper < lower; ++upper, --lower) {
    std::swap_ranges(picture.rgb.begin() + std::ptrdiff_t(upper * row),
                     picture.rgb.begin() + std::ptrdiff_t((upper + 1) * row),
                     picture.rgb.begin() + std::ptrdiff_t(lower * row));
  }
  bind();
  return picture;
}

}  // namespace polhode::viewer::pictures
