// SPDX-License-Identifier: BSD-3-Clause
// The drawable contents of a scenario: the surface of each body as triangles, and the springs and joints between
// bodies.
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
      Vector3<double>::Zero();  ///< mass centre of a pinned body from its pivot, body axes, m
  Vector3<double> floor_normal = Vector3<double>::Zero();  ///< unit normal of a half-space, world axes
  double floor_offset = 0;                                 ///< offset of a half-space along the normal, m
  double mass = 0;                                         ///< kg
  Matrix3<double> inertia = Matrix3<double>::Identity();   ///< inertia about the reference point, body axes, kg m²
};

/// A point of one body and a point of another or of the world. Between them is a spring or a joint.
struct SceneLink {
  std::size_t body = 0;
  std::optional<std::size_t> other;
  Vector3<double> anchor = Vector3<double>::Zero();        ///< anchor in the body's axes from its reference point, m
  Vector3<double> anchor_other = Vector3<double>::Zero();  ///< anchor in the other's axes, or in the world, m
};

struct SceneJoint {
  std::string name;
  SceneLink ends;
  bool on_plane = false;                                 ///< the second anchor only says where a plane is
  Vector3<double> axis = Vector3<double>::Zero();        ///< unit vector in the body's axes; zero: the joint has none
  Vector3<double> axis_other = Vector3<double>::Zero();  ///< unit vector in the other's axes or the world; zero: none
  double radius = 0;  ///< radius of a disk or sphere that rolls on the plane, m; 0: a joint that does not roll
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit normal of the plane, in the other's axes or in the world
};

struct Scene {
  std::string title;
  std::vector<Surface> surfaces;  ///< each surface once, even if several bodies have it
  std::vector<SceneBody> bodies;  ///< all bodies of the problem, in its order
  std::vector<SceneLink> springs;
  std::vector<SceneJoint> joints;  ///< all joints of the problem, in its order
};

Scene scene_of(const Scenario& scenario);

}  // namespace polhode::study::scene
