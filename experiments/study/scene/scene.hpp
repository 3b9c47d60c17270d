// SPDX-License-Identifier: BSD-3-Clause
// The drawable contents of a scenario: the surface of each body as triangles, and the springs between bodies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collision/pose.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/scene/surface.hpp"

namespace polhode::study::inline scene {

struct SceneBody {
  std::string name;
  std::optional<std::size_t> surface;  ///< index into Scene::surfaces; absent: a half-space, which is drawn as a floor
  bool fixed = false;
  bool from_inertia = false;  ///< the scenario names no shape; a box of the same mass and inertia is drawn
  Pose start;                 ///< pose of the surface; a fixed body stays there
  Vector3<double> center_of_mass =
      Vector3<double>::Zero();                             ///< m, body axes, from the reference point; of pinned bodies
  Vector3<double> floor_normal = Vector3<double>::Zero();  ///< of a half-space: unit normal, world
  double floor_offset = 0;                                 ///< of a half-space: m, along the normal
  double mass = 0;                                         ///< kg
  Matrix3<double> inertia = Matrix3<double>::Identity();   ///< kg m², body axes, about the reference point
};

/// A spring, drawn as a line from a point of one body to a point of another or of the world.
struct SceneSpring {
  std::size_t body = 0;
  std::optional<std::size_t> other;
  Vector3<double> anchor = Vector3<double>::Zero();        ///< m, in the body's axes from its reference point
  Vector3<double> anchor_other = Vector3<double>::Zero();  ///< m, in the other's axes, or in the world
};

struct Scene {
  std::string title;
  std::vector<Surface> surfaces;  ///< each surface once, even if several bodies have it
  std::vector<SceneBody> bodies;  ///< all bodies of the problem, in its order
  std::vector<SceneSpring> springs;
};

Scene scene_of(const Scenario& scenario);

}  // namespace polhode::study::scene
