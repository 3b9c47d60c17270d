// SPDX-License-Identifier: BSD-3-Clause
// What of a scenario can be drawn: the surface of each body as triangles, and the springs between bodies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collision/pose.hpp"
#include "experiments/scene/surface.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline scene {

struct SceneBody {
  std::string name;
  std::optional<std::size_t> surface;  ///< among Scene::surfaces; none: a half-space, which is drawn as a floor
  bool fixed = false;
  bool from_inertia = false;  ///< the scenario names no shape: the box of the same mass and inertia stands for it
  Pose start;                 ///< of the surface; a fixed body stays there
  Vector3<double> center_of_mass =
      Vector3<double>::Zero();                             ///< m, body axes, from the reference point; of pinned bodies
  Vector3<double> floor_normal = Vector3<double>::Zero();  ///< of a half-space, world
  double floor_offset = 0;                                 ///< m, along the normal
  double mass = 0;                                         ///< kg
  Matrix3<double> inertia = Matrix3<double>::Identity();   ///< kg m², body axes, about the reference point
};

/// A line from a point of one body to one of another, or of the world.
struct SceneSpring {
  std::size_t body = 0;
  std::optional<std::size_t> other;
  Vector3<double> anchor = Vector3<double>::Zero();        ///< m, in the body's axes from its reference point
  Vector3<double> anchor_other = Vector3<double>::Zero();  ///< m, in the other's axes, or in the world
};

struct Scene {
  std::string title;
  std::vector<Surface> surfaces;  ///< each once, however many bodies have it
  std::vector<SceneBody> bodies;  ///< all of the problem, in its order
  std::vector<SceneSpring> springs;
};

Scene scene_of(const Scenario& scenario);

}  // namespace polhode::study
