// SPDX-License-Identifier: BSD-3-Clause
// Normals of a corner are the mean of those of its faces weighted by their angles there (Thürmer & Wüthrich, Computing
// vertex normals from polygonal facets, Journal of Graphics Tools 3(1), 1998).
#include "experiments/study/scene/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "collision/shapes/box.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/convex_hull.hpp"

namespace polhode::study::inline scene {

namespace {

using std::numbers::pi;

constexpr int meridians = 48, rings = 24;  // 7.5 degrees apart
const double sharp = std::cos(pi / 6);

/// The cosine of a whole number of parts of a turn, where it is zero exactly so.
double cosine(int part, int parts) {
  const double c = std::cos(2 * pi * part / parts);
  return std::abs(c) < 1e-15 ? 0 : c;
}
double sine(int part, int parts) { return cosine(part - parts / 4, parts); }

/// Rings about axis 3, which is the axis of shapes that have one, and the axes and diagonals of a cube. Of a long shape
/// the rings are drawn together across it, halfway (in ratios) between what spreads the points of an ellipsoid evenly
/// and what spreads normals evenly.
std::vector<Vector3<double>> spread_directions(const Vector3<double>& sizes) {
  const Vector3<double> scale = sizes.cwiseSqrt();
  std::vector<Vector3<double>> all;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        if (i != 0 || j != 0 || k != 0) all.push_back({double(i), double(j), double(k)});
      }
    }
  }
  for (int ring = 1; ring < rings; ++ring) {
    const double across = sine(ring, 2 * rings), along = cosine(ring, 2 * rings);
    for (int k = 0; k < meridians; ++k) {
      all.push_back(
          Vector3<double>(across * cosine(k, meridians), across * sine(k, meridians), along).cwiseQuotient(scale));
    }
  }
  return all;
}

/// The points that the shape reaches, each once.
std::vector<Vector3<double>> reached(const Shape& shape) {
  const Vector3<double> sizes = shape.bounds({}).sizes();
  const double close = 1e-9 * sizes.maxCoeff();
  std::vector<Vector3<double>> points;
  for (const Vector3<double>& d : spread_directions(sizes)) {
    const Vector3<double> x = shape.support(d);
    const auto same = [&](const Vector3<double>& p) { return (p - x).cwiseAbs().maxCoeff() <= close; };
    if (std::none_of(points.begin(), points.end(), same)) points.push_back(x);
  }
  return points;
}

/// The angle of a face at one of its corners, rad.
double angle_at(const Polytope& p, const Polytope::Face& face, std::uint32_t i) {
  const auto vertex = [&](std::uint32_t k) { return p.vertices[p.corners[face.first + k % face.count].vertex]; };
  const Vector3<double> to = vertex(i + 1) - vertex(i), back = vertex(i + face.count - 1) - vertex(i);
  return std::atan2(to.cross(back).norm(), to.dot(back));
}

/// The faces around a vertex, in groups that go smoothly into each other.
class SmoothGroups {
 public:
  SmoothGroups(const Polytope& p, std::uint32_t vertex) : faces_(p.faces_of(vertex)) {
    for (std::uint32_t i = 0; i < faces_.size(); ++i) group_.push_back(i);
    for (const std::uint32_t other : p.neighbours_of(vertex)) {
      const auto key = std::pair(std::min(vertex, other), std::max(vertex, other));
      const auto edge =
          std::lower_bound(p.edges.begin(), p.edges.end(), key,
                           [](const Polytope::Edge& e, const auto& k) { return std::pair(e.from, e.to) < k; });
      if (p.faces[edge->left].normal.dot(p.faces[edge->right].normal) >= sharp)
        join(place(edge->left), place(edge->right));
    }
    part_tips(p);
  }

  std::span<const std::uint32_t> faces() const { return faces_; }
  std::uint32_t of(std::uint32_t face) const { return group_[place(face)]; }

 private:
  std::size_t place(std::uint32_t face) const {
    return std::size_t(std::lower_bound(faces_.begin(), faces_.end(), face) - faces_.begin());
  }
  void join(std::size_t a, std::size_t b) {
    const std::uint32_t keep = group_[a], gone = group_[b];
    std::replace(group_.begin(), group_.end(), gone, keep);
  }
  /// Round the tip of a cone each face goes smoothly into the next, and yet none has the direction of their sum.
  void part_tips(const Polytope& p) {
    std::vector<Vector3<double>> sums(faces_.size(), Vector3<double>::Zero());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) sums[group_[i]] += p.faces[faces_[i]].normal;
    std::vector<bool> tip(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      const Vector3<double>& sum = sums[group_[i]];
      if (p.faces[faces_[i]].normal.dot(sum) < sharp * sum.norm()) tip[group_[i]] = true;
    }
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (tip[group_[i]]) group_[i] = i;
    }
  }

  std::span<const std::uint32_t> faces_;
  std::vector<std::uint32_t> group_;
};

/// Adds the faces of a polytope; each corner gets a point for each of its normals.
void add_polytope(const Polytope& p, Surface& surface) {
  std::vector<std::uint32_t> point_of(p.corners.size());
  for (std::uint32_t v = 0; v < p.vertices.size(); ++v) {
    const SmoothGroups groups(p, v);
    std::vector<Vector3<double>> sums(groups.faces().size(), Vector3<double>::Zero());
    std::vector<std::uint32_t> numbers(sums.size(), 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;  // corners with their groups
    for (const std::uint32_t f : groups.faces()) {
      const Polytope::Face& face = p.faces[f];
      for (std::uint32_t i = 0; i < face.count; ++i) {
        if (p.corners[face.first + i].vertex != v) continue;
        sums[groups.of(f)] += angle_at(p, face, i) * face.normal;
        corners.emplace_back(face.first + i, groups.of(f));
      }
    }
    for (std::size_t g = 0; g < sums.size(); ++g) {
      if (sums[g].isZero(0)) continue;
      numbers[g] = std::uint32_t(surface.points.size());
      surface.points.push_back(p.vertices[v].cast<float>());
      surface.normals.push_back(sums[g].normalized().cast<float>());
    }
    for (const auto& [corner, group] : corners) point_of[corner] = numbers[group];
  }
  for (const Polytope::Face& face : p.faces) {
    for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
      for (const std::uint32_t k : {0u, i, i + 1}) surface.corners.push_back(point_of[face.first + k]);
    }
  }
}

/// Adds the surface of a shape; the box around it if it is too thin for a hull.
void add_convex(const Shape& shape, Surface& surface) {
  const std::vector<Vector3<double>> points = reached(shape);
  try {
    add_polytope(ConvexHull(points).polytope(), surface);
  } catch (const std::invalid_argument&) {
    const Bounds around = shape.bounds({});
    const std::size_t first = surface.points.size();
    add_polytope(Box(around.sizes() / 2).polytope(), surface);
    for (std::size_t i = first; i < surface.points.size(); ++i) surface.points[i] += around.center().cast<float>();
  }
}

}  // namespace

Surface surface_of(const Shape& shape) {
  if (!shape.finite())
    throw std::invalid_argument("a " + std::string(shape.kind()) + " has no end, and so no surface of triangles");
  Surface surface;
  if (const auto* hull = dynamic_cast<const ConvexHull*>(&shape)) {
    add_polytope(hull->polytope(), surface);
  } else if (const auto* compound = dynamic_cast<const Compound*>(&shape)) {
    for (const Compound::Part& part : compound->parts()) add_polytope(part->polytope(), surface);
  } else {
    add_convex(shape, surface);
  }
  return surface;
}

}  // namespace polhode::study::scene
