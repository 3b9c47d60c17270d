// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/pictures/show_offscreen.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "experiments/viewer/overlay/captions.hpp"
#include "experiments/viewer/overlay/gui.hpp"
#include "experiments/viewer/overlay/plots.hpp"
#include "experiments/viewer/pictures/film.hpp"
#include "experiments/viewer/pictures/offscreen.hpp"
#include "experiments/viewer/pictures/png.hpp"

namespace polhode::viewer::inline pictures {
namespace {

constexpr int plots_height = 170;

}  // namespace

int show_offscreen(StageSetup setup, const OffscreenSettings& settings) {
  Stage stage(std::move(setup));
  show(settings.shown, stage);
  const bool plots = settings.plots;
  const Rectangle area = {0, plots ? plots_height : 0, settings.width, settings.height - (plots ? plots_height : 0)};
  stage.want();
  stage.each([&](Session& s) { s.pause_on_collision(settings.pause_on_collision); });
  stage.each([](Session& s) { s.play(); });
  const auto go_on = [&](double seconds) {  // in parts so short that no session drops time
    constexpr double piece = 0.25;
    for (double left = seconds; left > 0; left -= piece) {
      stage.tick(std::min(left, piece));
      stage.each([](Session& s) { s.settle(); });
    }
  };
  if (settings.from && *settings.from > 0) go_on(*settings.from);
  stage.each([](Session& s) { s.settle(); });
  stage.look_at_all();

  Offscreen target(settings.width, settings.height, settings.samples);
  Gui gui;
  StagePainter painter(stage);
  stage.place_camera(double(area.width) / area.height);
  if (settings.shown.azimuth) stage.camera.azimuth = *settings.shown.azimuth;
  if (settings.shown.elevation) stage.camera.elevation = *settings.shown.elevation;
  stage.camera.zoom(1 / settings.shown.zoom);
  std::optional<Film> film;
  if (!settings.film.empty()) film.emplace(settings.film, settings.width, settings.height, settings.frames_per_second);
  if (settings.frames) std::filesystem::create_directories(settings.out);

  const double between = settings.speed / settings.frames_per_second;
  const double duration =
      settings.duration.value_or(stage.views().front()->status.t_end - stage.views().front()->frame.t);
  const auto count = static_cast<int>(std::floor(duration / between * (1 + 1e-12))) + 1;
  int n = 0;
  while (true) {
    target.bind();
    painter.draw(stage, area);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, settings.width, settings.height);
    gui.begin_offscreen(settings.width, settings.height, between);
    if (settings.captions) write_captions(stage, painter.labels(stage, area, settings.height), area, settings.height);
    if (plots) draw_plots(stage, 0, float(settings.height - plots_height), float(settings.width), plots_height);
    gui.draw();
    const Picture picture = target.read();
    ++n;
    if (settings.frames) write_png(settings.out / fmt::format("frame_{:04}.png", n), picture);
    if (film) film->add(picture);
    bool paused = false;
    for (const auto& view : stage.views()) paused |= view->status.paused_at_collision;
    if (n >= count || paused) break;
    go_on(between);
    stage.look_at_all();
  }
  if (film) film->finish();
  if (const std::string unwritten = stage.finish(); !unwritten.empty()) throw std::runtime_error(unwritten);
  return n;
}

}  // namespace polhode::viewer::pictures
