// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/surface_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace polhode::viewer::inline drawing {

namespace {

using Key = std::array<float, 3>;

Key key(const Vector3<float>& x) { return {x[0] + 0.0f, x[1] + 0.0f, x[2] + 0.0f}; }  // −0 is 0

/// One side of an edge: the normals at its ends, in the order of the ends.
struct Side {
  std::array<Vector3<float>, 2> normals;
};

class EdgeFinder {
 public:
  explicit EdgeFinder(const study::Surface& surface) : surface_(surface) {
    for (std::size_t t = 0; t + 2 < surface.corners.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [from, to] = ends(t, k);
        const bool forwards = key(surface.points[from]) < key(surface.points[to]);
        const std::uint32_t low = forwards ? from : to, high = forwards ? to : from;
        sides_[{key(surface.points[low]), key(surface.points[high])}].push_back(
            {{surface.normals[low], surface.normals[high]}});
      }
    }
  }

  /// The edge of triangle t opposite its corner k.
  bool drawn(std::size_t t, std::size_t k) const {
    const auto [from, to] = ends(t, k);
    const Key a = key(surface_.points[from]), b = key(surface_.points[to]);
    const std::vector<Side>& sides = sides_.at(std::minmax(a, b));
    if (sides.size() != 2) return true;
    constexpr float one_degree = 0.0175f;
    for (std::size_t end = 0; end < 2; ++end) {
      if ((sides[0].normals[end] - sides[1].normals[end]).norm() > one_degree) return true;
    }
    return false;
  }

 private:
  std::pair<std::uint32_t, std::uint32_t> ends(std::size_t t, std::size_t k) const {
    return {surface_.corners[t + (k + 1) % 3], surface_.corners[t + (k + 2) % 3]};
  }
  const study::Surface& surface_;
  std::map<std::pair<Key, Key>, std::vector<Side>> sides_;
};

}  // namespace

SurfaceMesh mesh_of(const study::Surface& surface) {
  SurfaceMesh mesh;
  for (const Vector3<float>& x : surface.points) mesh.radius = std::max(mesh.radius, x.norm());
  const float far = 1000 * mesh.radius;
  const EdgeFinder edges(surface);
  std::map<std::array<float, 9>, std::uint32_t> known;
  for (std::size_t t = 0; t + 2 < surface.corners.size(); t += 3) {
    std::array<Vector3<float>, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = surface.points[surface.corners[t + k]];
    const float doubled_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    std::array<Vector3<float>, 3> from_edges;
    for (std::size_t k = 0; k < 3; ++k) {
      const float length = (p[(k + 1) % 3] - p[(k + 2) % 3]).norm();
      const bool drawn = length > 0 && edges.drawn(t, k);
      for (std::size_t at = 0; at < 3; ++at) {
        from_edges[at][Eigen::Index(k)] = !drawn ? far : at == k ? doubled_area / length : 0.0f;
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const MeshVertex v{p[k], surface.normals[surface.corners[t + k]], from_edges[k]};
      const auto [at, is_new] = known.try_emplace({v.point[0], v.point[1], v.point[2], v.normal[0], v.normal[1],
                                                   v.normal[2], v.from_edges[0], v.from_edges[1], v.from_edges[2]},
                                                  std::uint32_t(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(v);
      mesh.corners.push_back(at->second);
    }
  }
  return mesh;
}

}  // namespace polhode::viewer::drawing
