// SPDX-License-Identifier: BSD-3-Clause
// Runs of one scenario side by side: their sessions, the camera, and what is shown.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/viewer/drawing/camera.hpp"
#include "experiments/viewer/drawing/renderer.hpp"
#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline stage {

struct StageSetup {
  std::string scenario;  ///< a built-in name or a path
  std::vector<study::Override> overrides;
  std::vector<Configuration> configurations;  ///< one for each run; at least one
  std::vector<std::string> trajectories;      ///< recorded trajectories; if there are any, configurations are not used
  std::filesystem::path out;                  ///< folder for recorded sessions, session_1.toml and so on; empty: none
  std::filesystem::path trajectory;           ///< folder for their motion; empty: none
};

/// Everything but the drawing, which needs an OpenGL context: sessions, their clock, camera, and what is shown.
class Stage {
 public:
  /// Throws InputError.
  explicit Stage(StageSetup setup);

  const StageSetup& setup() const { return setup_; }
  const study::Scene& scene() const { return scene_; }
  const std::vector<std::string>& moving() const { return moving_; }  ///< names of the moving bodies
  bool live() const { return setup_.trajectories.empty(); }

  std::size_t size() const { return sessions_.size(); }
  Session& session(std::size_t k) { return *sessions_[k]; }
  std::string title(std::size_t k, const View& view) const;

  void each(const std::function<void(Session&)>& command);
  void tick(double seconds);
  /// Adds a run from the start and resets the others, so that they can be compared.
  void add(const Configuration& configuration);
  void remove(std::size_t k);
  /// Ends all sessions. Returns one line about files that could not be written; empty: none.
  std::string finish();

  /// Requests from the sessions the data that are shown.
  void want();
  /// Updates and returns the views of this frame, the same ones for pictures, labels and plots.
  const std::vector<std::shared_ptr<const View>>& look_at_all();
  const std::vector<std::shared_ptr<const View>>& views() const { return views_; }
  /// Moves the camera as near as possible with all runs visible.
  void place_camera(double width_over_height);
  /// The rectangle of run k: a cell of a grid, the first run in the upper left corner.
  Rectangle part(std::size_t k, const Rectangle& area) const;

  Camera camera;
  Look look;
  bool cells = false;  ///< show the cells of the broad phase
  bool trails = true;
  std::size_t selected = 0;  ///< index of a moving body

 private:
  std::unique_ptr<Session> open(const Configuration& configuration);

  StageSetup setup_;
  study::Scene scene_;
  std::vector<std::string> moving_;
  std::vector<std::string> titles_;  ///< titles of recorded runs
  std::vector<std::unique_ptr<Session>> sessions_;
  std::string unwritten_;  ///< the first file that could not be written, and why
  std::vector<std::shared_ptr<const View>> views_;
  std::optional<Wanted> wanted_;  ///< the last request to the sessions
};

/// Draws the runs of a stage into a part of the current framebuffer.
class StagePainter {
 public:
  explicit StagePainter(const Stage& stage) : renderer_(stage.scene()) {}
  void draw(Stage& stage, const Rectangle& area);
  /// Texts with their places, in pixels of the whole picture from its left and upper edge.
  std::vector<Label> labels(Stage& stage, const Rectangle& area, int picture_height) const;

 private:
  Look look_of(const Stage& stage) const;
  Renderer renderer_;
};

}  // namespace polhode::viewer::stage
