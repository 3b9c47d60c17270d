// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/cast.hpp"

#include <algorithm>

namespace polhode::viewer::inline drawing {

namespace {

/// Distance (m) between the points of a link at the start.
double start_distance(const study::Scene& scene, const study::SceneLink& link) {
  const auto place = [&](std::size_t i, const Vector3<double>& anchor) {
    return scene.bodies[i].start.to_world(anchor - scene.bodies[i].center_of_mass);
  };
  return (place(link.body, link.anchor) - (link.other ? place(*link.other, link.anchor_other) : link.anchor_other))
      .norm();
}

}  // namespace

Cast cast_of(const study::Scene& scene) {
  std::vector<double> of_surface;
  for (const study::Surface& surface : scene.surfaces) {
    double radius = 0;
    for (const Vector3<float>& x : surface.points) radius = std::max(radius, double(x.norm()));
    of_surface.push_back(radius);
  }
  Cast cast;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const study::SceneBody& body = scene.bodies[i];
    if (body.fixed) continue;
    const double radius = body.surface ? of_surface[*body.surface] : 0;
    cast.moving.push_back(i);
    cast.radius.push_back(radius > 0 ? radius : 1);
  }
  if (cast.radius.empty()) return cast;
  std::vector<double> sorted = cast.radius;
  const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  cast.typical_radius = cast.joint_size = *middle;
  for (const study::SceneJoint& joint : scene.joints) {
    if (!joint.on_plane) cast.joint_size = std::max(cast.joint_size, start_distance(scene, joint.ends) / 2);
  }
  return cast;
}

}  // namespace polhode::viewer::drawing
