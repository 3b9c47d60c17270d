// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "collision/shapes/box.hpp"
#include "collision/shapes/half_space.hpp"
#include "core/problem/inertia.hpp"

namespace polhode::study::inline scene {

namespace {

constexpr double least_thickness = 0.04;  // thickness over the longest edge of a box that stands for an inertia
constexpr double post = 0.25;  // cube that marks a static body without a shape, over the smallest moving body

Pose start_of(const Body& body, const BodyStart& start) {
  const Matrix3<double> rotation = rotation_matrix(start.orientation);
  return {start.position + rotation * body.center_of_mass, rotation};
}

/// The box with the mass and the principal moments of a body, in body axes about the mass centre: with edges a, b, c
/// I_a = m (b² + c²)/12. Moments that no body has, and flat or thin bodies, get a least thickness.
Surface inertia_box(const Body& body) {
  const Matrix3<double> central = inertia_about_center(body.inertia, body.mass, body.center_of_mass);
  const PrincipalAxes principal = principal_axes(central);
  const Vector3<double> squares =
      6 / body.mass * (Vector3<double>::Constant(principal.moments.sum()) - 2 * principal.moments);
  Vector3<double> edges = squares.cwiseMax(0).cwiseSqrt();
  edges = edges.cwiseMax(least_thickness * edges.maxCoeff());
  Surface surface = surface_of(Box(edges / 2));
  const Matrix3<float> turn = principal.axes.cast<float>();
  for (Vector3<float>& x : surface.points) x = (turn * x).eval();
  for (Vector3<float>& n : surface.normals) n = (turn * n).eval();
  return surface;
}

/// Length from end to end along the axis where it is longest, m.
double extent(const Surface& surface) {
  Eigen::AlignedBox3f around;
  for (const Vector3<float>& x : surface.points) around.extend(x);
  return double(around.sizes().maxCoeff());
}

class SceneMaker {
 public:
  explicit SceneMaker(const Scenario& scenario) {
    scene_.title = scenario.title;
    const Problem& problem = scenario.problem;
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
      add_body(problem.bodies[i], problem.starts[i], scenario.shapes[i]);
    for (const ForceParameters& force : problem.forces) {
      if (force.kind == "spring" || force.kind == "damper") scene_.springs.push_back(link(force));
    }
    for (const JointParameters& joint : problem.joints) add_joint(joint, problem);
  }

  Scene scene() { return std::move(scene_); }

 private:
  void add_body(const Body& body, const BodyStart& start, const ShapePointer& shape) {
    SceneBody& b = scene_.bodies.emplace_back();
    b.name = body.name;
    b.fixed = body.fixed;
    b.start = start_of(body, start);
    b.center_of_mass = body.center_of_mass;
    b.mass = body.mass;
    b.inertia = body.inertia;
    if (!shape) {
      b.from_inertia = true;
      b.surface =
          add(body.fixed ? surface_of(Box(Vector3<double>::Constant(post / 2 * smallest()))) : inertia_box(body));
    } else if (const auto* floor = dynamic_cast<const HalfSpace*>(shape.get())) {
      b.floor_normal = b.start.rotation * floor->normal();
      b.floor_offset = floor->offset() + b.floor_normal.dot(b.start.position);
    } else {
      const auto [known, is_new] = surfaces_.emplace(shape.get(), scene_.surfaces.size());
      if (is_new) add(surface_of(*shape));
      b.surface = known->second;
    }
  }

  std::size_t add(Surface surface) {
    scene_.surfaces.push_back(std::move(surface));
    return scene_.surfaces.size() - 1;
  }

  /// Extent of the smallest body so far, m; moving bodies stand first.
  double smallest() const {
    double least = extent(scene_.surfaces.front());
    for (const SceneBody& b : scene_.bodies) {
      if (b.surface && !b.fixed) least = std::min(least, extent(scene_.surfaces[*b.surface]));
    }
    return least;
  }

  static SceneLink link(const ForceParameters& of) {
    SceneLink l;
    l.body = of.bodies[0];
    l.anchor = of.vector("anchor_body");
    if (of.bodies.size() == 2) l.other = of.bodies[1];
    l.anchor_other = of.vector(l.other ? "anchor_body_2" : "anchor_world");
    return l;
  }

  void add_joint(const JointParameters& joint, const Problem& problem) {
    const ForceParameters& of = joint.of;
    const bool rolls = of.kind == "rolling";
    SceneJoint& j = scene_.joints.emplace_back();
    j.name = joint.name;
    j.ends = link(of);
    j.on_plane = rolls || of.kind == "planar";
    const auto unit = [&](const char* key) {
      return of.values.contains(key) ? of.vector(key).normalized() : Vector3<double>(Vector3<double>::Zero());
    };
    j.axis = unit("axis_body");
    j.axis_other = unit("axis_body_2");
    if (!rolls) return;
    j.radius = of.number("radius");
    j.normal = unit("normal");
    if (j.ends.other)
      j.normal = rotation_matrix(problem.starts[*j.ends.other].orientation).transpose() * j.normal.eval();
  }

  Scene scene_;
  std::map<const Shape*, std::size_t> surfaces_;
};

}  // namespace

Scene scene_of(const Scenario& scenario) { return SceneMaker(scenario).scene(); }

}  // namespace polhode::study::scene
