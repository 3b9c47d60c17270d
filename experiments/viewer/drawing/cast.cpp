// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/cast.hpp"

#include <algorithm>

namespace polhode::viewer::inline drawing {

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
  cast.typical_radius = *middle;
  return cast;
}

}  // namespace polhode::viewer::drawing
