// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/places.hpp"

#include <algorithm>

namespace polhode::viewer::inline drawing {

Vector3<double> Places::point(std::size_t body, const Vector3<double>& in_body) const {
  return pose(body).to_world(in_body - scene_.bodies[body].center_of_mass);
}

Vector3<double> Places::direction(std::size_t body, const Vector3<double>& in_body) const {
  return pose(body).rotation * in_body;
}

Pose Places::pose(std::size_t body) const {
  const auto found = std::lower_bound(cast_.moving.begin(), cast_.moving.end(), body);
  if (found == cast_.moving.end() || *found != body) return scene_.bodies[body].start;
  const BodySnapshot<double>& b = frame_.bodies[std::size_t(found - cast_.moving.begin())];
  return {b.position, rotation_matrix(b.orientation)};
}

}  // namespace polhode::viewer::drawing
