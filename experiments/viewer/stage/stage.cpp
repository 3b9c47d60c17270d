// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/stage/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/viewer/drawing/default_camera.hpp"

namespace polhode::viewer::inline stage {
namespace {

using study::rounded;

/// The first session_N.toml that does not exist.
std::filesystem::path free_name(const std::filesystem::path& folder) {
  for (int n = 1;; ++n) {
    std::filesystem::path name = folder / fmt::format("session_{}.toml", n);
    if (!std::filesystem::exists(name)) return name;
  }
}

/// Method and step of the run, for a trajectory in the folder of a study; otherwise the name of its folder.
std::string title_of(const std::filesystem::path& trajectory) {
  const std::filesystem::path folder = std::filesystem::absolute(trajectory).parent_path();
  const std::filesystem::path table = folder.parent_path().parent_path() / "runs.csv";
  const std::string name = folder.filename().string();
  if (folder.parent_path().filename() != "trajectories" || !std::filesystem::exists(table)) return name;
  study::CsvReader runs(table.string());
  const std::size_t run = runs.column("run"), integrator = runs.column("integrator"), dt = runs.column("dt_s"),
                    tolerance = runs.column("tolerance");
  while (runs.next()) {
    if (runs.text(run) != name) continue;
    return runs.text(dt).empty() ? fmt::format("{}, tolerance {}", runs.text(integrator), rounded(runs.text(tolerance)))
                                 : fmt::format("{}, dt = {} s", runs.text(integrator), rounded(runs.text(dt)));
  }
  return name;
}

}  // namespace

Stage::Stage(StageSetup setup) : setup_(std::move(setup)) {
  if (live()) {
    for (const Configuration& c : setup_.configurations) sessions_.push_back(open(c));
  } else {
    for (const std::string& file : setup_.trajectories) {
      sessions_.push_back(recorded_session(file, setup_.scenario, setup_.overrides));
      titles_.push_back(title_of(file));
    }
  }
  const study::Scenario& scenario = sessions_.front()->scenario();
  scene_ = study::scene_of(scenario);
  for (std::size_t i = 0; i < scenario.problem.moving(); ++i) moving_.push_back(scenario.problem.bodies[i].name);
  look_at_all();
}

std::unique_ptr<Session> Stage::open(const Configuration& configuration) {
  SessionSetup s;
  s.scenario = setup_.scenario;
  s.overrides = setup_.overrides;
  s.configuration = configuration;
  if (!setup_.out.empty()) {
    std::filesystem::create_directories(setup_.out);
    s.record = free_name(setup_.out);
  }
  if (!setup_.trajectory.empty()) s.trajectory = setup_.trajectory / fmt::format("run_{}", sessions_.size() + 1);
  return live_session(s);
}

std::string Stage::title(std::size_t k, const View& view) const {
  if (!live()) return titles_[k];
  const study::RunConfig& run = view.configuration.run;
  if (view.configuration.drive == Drive::frame_clock) return run.integrator + ", frame clock";
  return run.dt ? fmt::format("{}, dt = {} s", run.integrator, rounded(*run.dt))
                : fmt::format("{}, tolerance {}", run.integrator, rounded(run.tolerance.value_or(0)));
}

void Stage::each(const std::function<void(Session&)>& command) {
  for (const auto& session : sessions_) command(*session);
}

void Stage::tick(double seconds) { tick_together(sessions_, seconds); }

void Stage::add(const Configuration& configuration) {
  sessions_.push_back(open(configuration));
  wanted_.reset();
  each([](Session& s) { s.reset(); });
}

void Stage::remove(std::size_t k) {
  if (sessions_.size() < 2) return;
  const std::string unwritten = sessions_[k]->finish();
  if (unwritten_.empty()) unwritten_ = unwritten;
  sessions_.erase(sessions_.begin() + std::ptrdiff_t(k));
}

std::string Stage::finish() {
  for (const auto& session : sessions_) {
    const std::string unwritten = session->finish();
    if (unwritten_.empty()) unwritten_ = unwritten;
  }
  return unwritten_;
}

void Stage::want() {
  constexpr std::size_t most_trails = 12;  // more would hide the bodies
  Wanted wanted;
  wanted.contacts = look.contacts;
  wanted.cells = cells;
  wanted.reactions = look.joints || look.reactions;
  if (trails && moving_.size() <= most_trails) {
    for (std::size_t i = 0; i < moving_.size(); ++i) wanted.traced.push_back(i);
  } else if (trails || look.polhode) {
    wanted.traced = {selected};
  }
  if (wanted_ == wanted) return;
  wanted_ = wanted;
  each([&](Session& s) { s.want(wanted); });
}

const std::vector<std::shared_ptr<const View>>& Stage::look_at_all() {
  views_.clear();
  for (const auto& session : sessions_) views_.push_back(session->view());
  return views_;
}

void Stage::place_camera(double width_over_height) {
  std::vector<Frame> frames;
  for (const auto& view : views_) frames.push_back(view->frame);
  const Rectangle one = part(0, {0, 0, int(1000 * width_over_height), 1000});
  camera = default_camera(scene_, frames, double(one.width) / one.height, look);
}

Rectangle Stage::part(std::size_t k, const Rectangle& area) const {
  const int n = int(sessions_.size()), columns = int(std::ceil(std::sqrt(n))), rows = (n + columns - 1) / columns;
  const int column = int(k) % columns, row = int(k) / columns;
  const int left = area.width * column / columns, right = area.width * (column + 1) / columns;
  const int upper = area.height * row / rows, lower = area.height * (row + 1) / rows;
  return {area.left + left, area.bottom + area.height - lower, right - left, lower - upper};
}

Look StagePainter::look_of(const Stage& stage) const {
  Look look = stage.look;
  look.cells = stage.cells;
  look.trails = stage.trails;
  if (stage.moving().size() > 1 || look.polhode) look.selected = stage.selected;
  return look;
}

void StagePainter::draw(Stage& stage, const Rectangle& area) {
  const Look look = look_of(stage);
  for (std::size_t k = 0; k < stage.size(); ++k) {
    const View& view = *stage.views()[k];
    std::vector<Trail> trails;
    std::vector<Vector3<double>> polhode;
    for (const Trace& trace : view.traces) {
      if (stage.trails) {
        Trail& trail = trails.emplace_back(Trail{trace.body, {}});
        for (const TracePoint& p : trace.points) trail.points.push_back(p.position);
      }
      if (look.polhode && trace.body == stage.selected) {
        for (const TracePoint& p : trace.points) polhode.push_back(p.omega_body);
      }
    }
    renderer_.draw(view.frame, stage.camera, look, stage.part(k, area), {trails, polhode});
  }
}

std::vector<Label> StagePainter::labels(Stage& stage, const Rectangle& area, int picture_height) const {
  std::vector<Label> all;
  const Look look = look_of(stage);
  for (std::size_t k = 0; k < stage.size(); ++k) {
    const Rectangle part = stage.part(k, area);
    for (Label label : renderer_.labels(stage.views()[k]->frame, stage.camera, look, part)) {
      label.right += part.left;
      label.down += picture_height - part.bottom - part.height;
      all.push_back(label);
    }
  }
  return all;
}

}  // namespace polhode::viewer::stage
