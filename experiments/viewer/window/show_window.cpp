// SPDX-License-Identifier: BSD-3-Clause
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "experiments/study/text/text_file.hpp"
#include "experiments/viewer/overlay/captions.hpp"
#include "experiments/viewer/overlay/panel.hpp"
#include "experiments/viewer/overlay/plots.hpp"
#include "experiments/viewer/pictures/offscreen.hpp"
#include "experiments/viewer/pictures/png.hpp"
#include "experiments/viewer/window/frame_clock.hpp"
#include "experiments/viewer/window/script.hpp"
#include "experiments/viewer/window/show_window.hpp"

namespace polhode::viewer::inline window {
namespace {

constexpr int panel_width = 320, plots_height = 170;

std::atomic<bool> asked_to_stop = false;
std::string glfw_fault;

/// A window with a context of OpenGL 3.3.
class Window {
 public:
  /// samples: number for each pixel; absent: 4, or 1 with a software renderer.
  Window(int width, int height, std::optional<int> samples) {
    glfwSetErrorCallback([](int, const char* text) { glfw_fault = text; });
    if (!glfwInit()) fail("no display");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_STENCIL_BITS, 8);
    open(width, height, samples.value_or(4));
    if (!samples && draws_in_software()) {  // several samples for each pixel triple the time of a software renderer
      glfwDestroyWindow(window_);
      open(width, height, 1);
    }
    glfwSwapInterval(1);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  GLFWwindow* get() const { return window_; }

 private:
  void open(int width, int height, int samples) {
    glfwWindowHint(GLFW_SAMPLES, samples > 1 ? samples : 0);
    window_ = glfwCreateWindow(width, height, "polhode", nullptr, nullptr);
    if (!window_) {
      glfwTerminate();
      fail("no window with OpenGL 3.3");
    }
    glfwMakeContextCurrent(window_);
  }
  [[noreturn]] static void fail(const std::string& what) {
    throw std::runtime_error(
        fmt::format("{} ({}); `./run replay` makes a page that plays in any browser, and `--offscreen` "
                    "pictures and films",
                    what, glfw_fault.empty() ? "GLFW does not say why" : glfw_fault));
  }
  GLFWwindow* window_ = nullptr;
};

Picture read_window(int width, int height) {
  Picture picture{width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 3)};
  std::vector<std::uint8_t> rows(picture.rgb.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
  const std::size_t row = std::size_t(width) * 3;
  for (std::size_t y = 0; y < std::size_t(height); ++y) {
    std::copy_n(rows.data() + (std::size_t(height) - 1 - y) * row, row, picture.rgb.data() + y * row);
  }
  return picture;
}

/// Applies mouse and keys that no control uses: the mouse moves the camera, keys change the time and what is shown.
void steer(Stage& stage) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!io.WantCaptureMouse) {
    constexpr double turn = 0.008, pan = 0.0012, zoom = 0.9;
    if (ImGui::IsMouseDragging(0)) stage.camera.orbit(-turn * double(io.MouseDelta.x), turn * double(io.MouseDelta.y));
    if (ImGui::IsMouseDragging(1) || ImGui::IsMouseDragging(2)) {
      stage.camera.pan(-pan * stage.camera.distance * double(io.MouseDelta.x),
                       pan * stage.camera.distance * double(io.MouseDelta.y));
    }
    if (io.MouseWheel != 0) stage.camera.zoom(std::pow(zoom, double(io.MouseWheel)));
  }
  if (io.WantCaptureKeyboard) return;
  if (ImGui::IsKeyPressed(GLFW_KEY_SPACE, false)) {
    const bool playing = stage.views().front()->status.playing;
    stage.each([&](Session& s) { playing ? s.pause() : s.play(); });
  }
  if (ImGui::IsKeyPressed(GLFW_KEY_RIGHT)) stage.each([](Session& s) { s.step(); });
  if (ImGui::IsKeyPressed(GLFW_KEY_HOME, false)) stage.each([](Session& s) { s.reset(); });
  if (ImGui::IsKeyPressed(GLFW_KEY_J, false)) stage.look.joints = !stage.look.joints;
  if (ImGui::IsKeyPressed(GLFW_KEY_R, false)) stage.look.reactions = !stage.look.reactions;
}

/// A window that shows one stage after another.
class Show {
 public:
  Show(StageSetup setup, const WindowSettings& settings)
      : settings_(settings), window_(settings.width, settings.height, settings.samples) {
    ImGui_ImplGlfw_InitForOpenGL(window_.get(), true);
    if (!settings.script.empty()) {
      script_.emplace(
          settings.script, [this](const std::string& file) { picture_ = file; },
          [this](const std::string& file) { write_places(file); });
    }
    set(std::move(setup));
    if (settings_.play) stage_->each([](Session& s) { s.play(); });
  }
  ~Show() { ImGui_ImplGlfw_Shutdown(); }
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;

  void run() {
    FrameClock clock;
    double seconds = 0;
    std::int64_t frames = 0;
    while (!glfwWindowShouldClose(window_.get()) && !asked_to_stop &&
           !(script_ && script_->done() && picture_.empty())) {
      glfwPollEvents();
      const double passed = clock.tick();
      seconds += passed;
      ++frames;
      frame(passed);
    }
    keep_in_mind(stage_->finish());
    if (!unwritten_.empty()) throw std::runtime_error(unwritten_);
    fmt::print("{} frames in {:.1f} s, {:.1f} per second\n", frames, seconds,
               seconds > 0 ? double(frames) / seconds : 0.0);
  }

 private:
  void set(StageSetup setup) {
    painter_.reset();
    auto stage = std::make_unique<Stage>(std::move(setup));
    if (stage_) keep_in_mind(stage_->finish());
    stage_ = std::move(stage);
    show(settings_.shown, *stage_);
    stage_->each([this](Session& s) { s.set_speed(settings_.speed); });
    painter_ = std::make_unique<StagePainter>(*stage_);
    home();
  }

  void keep_in_mind(const std::string& unwritten) {
    if (unwritten_.empty()) unwritten_ = unwritten;
  }

  void home() {
    stage_->place_camera(double(settings_.width - panel_width) / (settings_.height - plots_height));
    if (settings_.shown.azimuth) stage_->camera.azimuth = *settings_.shown.azimuth;
    if (settings_.shown.elevation) stage_->camera.elevation = *settings_.shown.elevation;
    stage_->camera.zoom(1 / settings_.shown.zoom);
  }

  void frame(double passed) {
    stage_->tick(passed);
    stage_->want();
    stage_->look_at_all();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    if (script_) script_->before_frame();
    ImGui::NewFrame();
    gui_.controls.begin_frame();
    const PanelWishes wishes = panel_.draw(*stage_, gui_.controls, panel_width, float(height));
    draw_plots(*stage_, panel_width, float(height - plots_height), float(width - panel_width), plots_height);
    steer(*stage_);
    const Rectangle area = {panel_width, plots_height, std::max(width - panel_width, 1),
                            std::max(height - plots_height, 1)};
    area_ = area;
    height_ = height;
    if (script_)
      script_->set_view(float(area.left) + float(area.width) / 2, float(height - area.bottom) - float(area.height) / 2);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    painter_->draw(*stage_, area);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, width, height);
    write_captions(*stage_, painter_->labels(*stage_, area, height), area, height);
    gui_.draw();
    if (wishes.picture) picture_ = next_picture();
    if (!picture_.empty()) {
      write_png(picture_, read_window(width, height));
      fmt::print("{}\n", picture_.string());
      std::fflush(stdout);
      picture_.clear();
    }
    glfwSwapBuffers(window_.get());
    if (script_) script_->after_frame(*stage_, gui_.controls);
    if (wishes.camera) home();
    if (wishes.scenario) other(*wishes.scenario);
  }

  /// Writes the places of the bodies in the last frame, and their colours.
  void write_places(const std::filesystem::path& file) const {
    std::string csv = "run,body,x_px,y_px,red,green,blue\n";
    for (std::size_t k = 0; k < stage_->size(); ++k) {
      const Rectangle part = stage_->part(k, area_);
      const auto& bodies = stage_->views()[k]->frame.bodies;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto at = stage_->camera.pixel(bodies[i].position, part.width, part.height);
        if (!at) continue;
        const Colour c = body_colour(i);
        csv += fmt::format("{},{},{:.2f},{:.2f},{},{},{}\n", k + 1, stage_->moving()[i], part.left + (*at)[0],
                           height_ - part.bottom - part.height + (*at)[1], c.red, c.green, c.blue);
      }
    }
    study::write_text(file, csv);
  }

  std::filesystem::path next_picture() {
    std::filesystem::create_directories(settings_.out);
    for (int n = 1;; ++n) {
      std::filesystem::path path = settings_.out / fmt::format("picture_{}.png", n);
      if (!std::filesystem::exists(path)) return path;
    }
  }

  void other(const std::string& scenario) {
    StageSetup setup = stage_->setup();
    setup.scenario = scenario;
    setup.overrides.clear();
    const study::Scenario read = study::ScenarioSource::open(scenario).resolve();
    setup.configurations = {usual_configuration(read)};
    set(std::move(setup));
  }

  WindowSettings settings_;
  Window window_;
  Gui gui_;
  Panel panel_;
  std::optional<Script> script_;
  std::unique_ptr<Stage> stage_;
  std::unique_ptr<StagePainter> painter_;
  std::filesystem::path picture_;
  std::string unwritten_;  ///< the first file that could not be written, and why
  Rectangle area_;         ///< rectangle in which the runs were drawn last
  int height_ = 0;         ///< height of the picture, pixels
};

}  // namespace

void show_window(StageSetup setup, const WindowSettings& settings) {
  std::signal(SIGINT, [](int) { asked_to_stop = true; });
  std::signal(SIGTERM, [](int) { asked_to_stop = true; });
  Show(std::move(setup), settings).run();
}

}  // namespace polhode::viewer::window
