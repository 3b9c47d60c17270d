// SPDX-License-Identifier: BSD-3-Clause
// Runs of one scenario side by side: what moves, what of it is looked at, and from where.
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
  std::vector<std::string> trajectories;      ///< recorded ones; where there are any, configurations are not read
  std::filesystem::path out;                  ///< where sessions are recorded: session_1.toml and so on; empty: nowhere
  std::filesystem::path trajectory;           ///< where their motion is written; empty: nowhere
};

/// All but the drawing, which wants a context: sessions, their clock, camera, and what is shown.
class Stage {
 public:
  /// Throws InputError.
  explicit Stage(StageSetup setup);

  const StageSetup& setup() const { return setup_; }
  const study::Scene& scene() const { return scene_; }
  const std::vector<std::string>& moving() const { return moving_; }  ///< names
  bool live() const { return setup_.trajectories.empty(); }

  std::size_t size() const { return sessions_.size(); }
  Session& session(std::size_t k) { return *sessions_[k]; }
  std::string title(std::size_t k, const View& view) const;

  void each(const std::function<void(Session&)>& command);
  void tick(double seconds);
  /// One more run from the start, and the others back to theirs, so that they compare.
  void add(const Configuration& configuration);
  void remove(std::size_t k);
  /// Ends all sessions. Returns what of any of them could not be written, in one line; empty: nothing.
  std::string finish();

  /// Tells the sessions what is wanted of them, by what is shown.
  void want();
  /// The views of this frame: the same for pictures, labels and plots.
  const std::vector<std::shared_ptr<const View>>& look_at_all();
  const std::vector<std::shared_ptr<const View>>& views() const { return views_; }
  /// Sees all runs from as near as it can.
  void place_camera(double width_over_height);
  /// The part of a picture that is of run k: a grid, the first in the upper left corner.
  Rectangle part(std::size_t k, const Rectangle& area) const;

  Camera camera;
  Look look;
  bool cells = false;  ///< of the broad phase
  bool trails = true;
  std::size_t selected = 0;  ///< among the moving bodies

 private:
  std::unique_ptr<Session> open(const Configuration& configuration);

  StageSetup setup_;
  study::Scene scene_;
  std::vector<std::string> moving_;
  std::vector<std::string> titles_;  ///< of recorded runs
  std::vector<std::unique_ptr<Session>> sessions_;
  std::string unwritten_;  ///< the first file that could not be written, and why
  std::vector<std::shared_ptr<const View>> views_;
  std::optional<Wanted> wanted_;  ///< as the sessions were told
};

/// Draws the runs of a stage into a part of the current framebuffer.
class StagePainter {
 public:
  explicit StagePainter(const Stage& stage) : renderer_(stage.scene()) {}
  void draw(Stage& stage, const Rectangle& area);
  /// Where text belongs, in pixels of the whole picture from its left and upper edge.
  std::vector<Label> labels(Stage& stage, const Rectangle& area, int picture_height) const;

 private:
  Look look_of(const Stage& stage) const;
  Renderer renderer_;
};

}  // namespace polhode::viewer
