// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/support_feature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "collision/narrow/patch.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "collision/shapes/cylinder.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

using Kind = SupportFeature::Kind;
using Corner = SupportFeature::Corner;

constexpr double sine_of_rocking = 0.0998;  // sine of the angle whose cosine is cosine_of_rocking

std::uint32_t edge_between(const Polytope& p, std::uint32_t u, std::uint32_t v) {
  const std::uint32_t from = std::min(u, v), to = std::max(u, v);
  const auto before = [&](const Polytope::Edge& e, const std::pair<std::uint32_t, std::uint32_t>& ends) {
    return std::pair(e.from, e.to) < ends;
  };
  return std::uint32_t(std::lower_bound(p.edges.begin(), p.edges.end(), std::pair(from, to), before) - p.edges.begin());
}

void polytope_feature(const Polytope& p, std::uint32_t vertex, const Vector3<double>& d, SupportFeature& f) {
  double best = cosine_of_rocking;
  for (const std::uint32_t face : p.faces_of(vertex)) {
    const double cosine = p.faces[face].normal.dot(d);
    if (cosine < best || (f.kind == Kind::face && cosine == best)) continue;
    best = cosine;
    f.kind = Kind::face;
    f.face = face;
  }
  if (f.kind == Kind::face) {
    f.normal = p.faces[f.face].normal;
    for (const Polytope::Corner& c : p.corners_of(f.face))
      f.corners.push_back({p.vertices[c.vertex], c.vertex, c.edge});
    return;
  }
  double least = sine_of_rocking;
  std::uint32_t other = vertex;
  for (const std::uint32_t neighbour : p.neighbours_of(vertex)) {
    const Vector3<double> along = p.vertices[neighbour] - p.vertices[vertex];
    const double sine = std::abs(along.dot(d)) / along.norm();
    if (sine >= least) continue;
    least = sine;
    other = neighbour;
  }
  if (other == vertex) {
    f.corners.push_back({p.vertices[vertex], vertex, 0});
    return;
  }
  f.kind = Kind::edge;
  const std::uint32_t edge = edge_between(p, vertex, other);
  for (const std::uint32_t v : {std::min(vertex, other), std::max(vertex, other)})
    f.corners.push_back({p.vertices[v], v, edge});
}

std::uint32_t furthest_vertex(const Polytope& p, const Vector3<double>& d) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 1; v < p.vertices.size(); ++v) {
    if (p.vertices[v].dot(d) > p.vertices[best].dot(d)) best = v;
  }
  return best;
}

/// A segment along axis 3, moved outwards to the surface.
void side(double half, const Vector3<double>& outwards, std::uint32_t first_vertex, std::uint32_t edge,
          SupportFeature& f) {
  f.kind = Kind::edge;
  f.corners.push_back({outwards + Vector3<double>(0, 0, -half), first_vertex, edge});
  f.corners.push_back({outwards + Vector3<double>(0, 0, half), first_vertex + 1, edge});
}

/// The rim's corners stand where they do in the cylinder's axes, so that they stay; between them, the one that is
/// lowest.
void end_of_cylinder(double radius, double half, const Vector3<double>& d, SupportFeature& f) {
  constexpr std::uint32_t corners = 16, numbers = 32;
  constexpr double step = 2 * std::numbers::pi / corners;
  const std::uint32_t face = d[2] > 0 ? 1 : 0;
  const double up = face == 1 ? 1 : -1, tilt = std::hypot(d[0], d[1]);
  f.kind = Kind::face;
  f.face = face;
  f.normal = {0, 0, up};
  const auto add = [&](double angle, std::uint32_t k) {
    f.corners.push_back(
        {{radius * std::cos(angle), up * radius * std::sin(angle), up * half}, numbers * face + k, numbers * face + k});
  };
  // A corner that is lower than its neighbours by round-off only is not worth an additional corner.
  const double lowest = tilt > 1e-6 ? std::atan2(up * d[1], d[0]) : -1;
  const double place = (lowest < 0 ? lowest + 2 * std::numbers::pi : lowest) / step;
  const bool between = tilt > 1e-6 && std::abs(place - std::round(place)) > 1e-6;
  for (std::uint32_t k = 0; k < corners; ++k) {
    add(k * step, k);
    if (between && std::uint32_t(place) == k) add(lowest, corners);
  }
}

void cylinder_feature(const Cylinder& c, const Vector3<double>& d, SupportFeature& f) {
  const double half = c.length() / 2, across = std::hypot(d[0], d[1]);
  if (std::abs(d[2]) >= cosine_of_rocking) return end_of_cylinder(c.radius(), half, d, f);
  if (std::abs(d[2]) <= sine_of_rocking)
    return side(half, {c.radius() * d[0] / across, c.radius() * d[1] / across, 0}, 64, 64, f);
  f.corners.push_back({c.support(d), d[2] > 0 ? 97u : 96u, 0});
}

void capsule_feature(const Capsule& c, const Vector3<double>& d, SupportFeature& f) {
  if (c.length() > 0 && std::abs(d[2]) <= sine_of_rocking) return side(c.length() / 2, c.radius() * d, 0, 0, f);
  f.corners.push_back({c.support(d), d[2] > 0 ? 1u : 0u, 0});
}

}  // namespace

void support_feature(const Shape& shape, const Vector3<double>& d, SupportFeature& f) {
  f.kind = Kind::point;
  f.face = 0;
  f.corners.clear();
  switch (shape.tag()) {
    case ShapeTag::box: {
      const Polytope& p = static_cast<const Box&>(shape).polytope();
      return polytope_feature(p, furthest_vertex(p, d), d, f);
    }
    case ShapeTag::convex_hull: {
      const auto& hull = static_cast<const ConvexHull&>(shape);
      return polytope_feature(hull.polytope(), hull.support_vertex(d), d, f);
    }
    case ShapeTag::capsule: return capsule_feature(static_cast<const Capsule&>(shape), d, f);
    case ShapeTag::cylinder: return cylinder_feature(static_cast<const Cylinder&>(shape), d, f);
    default: f.corners.push_back({shape.support(d), 0, 0});
  }
}

}  // namespace polhode::collision::narrow
