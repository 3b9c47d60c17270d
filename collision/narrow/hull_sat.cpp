// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/hull_sat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "collision/narrow/face_normals.hpp"
#include "collision/narrow/pair_order.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/sphere.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

using Vector = Vector3<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double round_off = 1e-15;  // rounding error of a separation, in units of Pair::scale
constexpr double parallel = 1e-15;   // sine of an angle below which two edges span no axis that faces do not
constexpr double generous = 1e-9;    // sine by which arcs may miss each other

/// The polytope within a shape, in A's axes. Of a ball it is the centre, of a capsule its segment; these have one edge,
/// which may be of no length, and no faces.
struct Core {
  double radius = 0;  // radius of the shape around the polytope, m
  const Polytope* polytope = nullptr;
  std::vector<Vector> vertices, normals;
  std::span<const Polytope::Edge> edges;

  Vector along(const Polytope::Edge& e) const { return vertices[e.to] - vertices[e.from]; }
  bool flat() const { return polytope == nullptr; }

  double highest(const Vector& n) const {
    double most = -infinity;
    for (const Vector& v : vertices) most = std::max(most, n.dot(v));
    return most;
  }
  double lowest(const Vector& n) const { return -highest(-n); }

  /// Height of face f along its own normal.
  double height(std::uint32_t f) const {
    double most = -infinity;
    for (const Polytope::Corner c : polytope->corners_of(f)) most = std::max(most, normals[f].dot(vertices[c.vertex]));
    return most;
  }

  void set(const Shape& shape, const Matrix3<double>& turn, const Vector& offset) {
    static constexpr Polytope::Edge point[] = {{0, 0, 0, 0}}, segment[] = {{0, 1, 0, 0}};
    radius = 0;
    polytope = nullptr;
    vertices.clear();
    normals.clear();
    switch (shape.tag()) {
      case ShapeTag::sphere:
        radius = static_cast<const Sphere&>(shape).radius();
        vertices.push_back(offset);
        edges = point;
        return;
      case ShapeTag::capsule: {
        const auto& capsule = static_cast<const Capsule&>(shape);
        radius = capsule.radius();
        const Vector half = turn.col(2) * (0.5 * capsule.length());
        vertices.push_back(offset - half);
        vertices.push_back(offset + half);
        edges = segment;
        return;
      }
      case ShapeTag::box: polytope = &static_cast<const Box&>(shape).polytope(); break;
      default: polytope = &static_cast<const ConvexHull&>(shape).polytope();
    }
    for (const Vector& v : polytope->vertices) vertices.push_back(offset + turn * v);
    for (const Polytope::Face& f : polytope->faces) normals.push_back(turn * f.normal);
    edges = polytope->edges;
  }
};

struct Axis {
  double separation = -infinity;   // separation along the normal, negative if the shapes overlap, m
  Vector normal = Vector::Zero();  // unit normal from A to B, in A's axes; zero: none
};

/// Features of a core that may contain the nearest point.
struct Near {
  std::vector<std::uint8_t> vertex;
  std::vector<std::uint32_t> edges, faces;

  void reserve(const Core& core) {
    vertex.reserve(core.vertices.size());
    edges.reserve(core.edges.size());
    faces.reserve(core.normals.size());
  }

  /// Selects the features with a vertex at height `least` or more along n.
  void set(const Core& core, const Vector& n, double least) {
    vertex.clear();
    edges.clear();
    faces.clear();
    for (const Vector& v : core.vertices) vertex.push_back(n.dot(v) >= least);
    for (std::uint32_t e = 0; e < core.edges.size(); ++e) {
      if (vertex[core.edges[e].from] || vertex[core.edges[e].to]) edges.push_back(e);
    }
    if (core.flat()) return;
    for (std::uint32_t f = 0; f < core.normals.size(); ++f) {
      const auto corners = core.polytope->corners_of(f);
      if (std::any_of(corners.begin(), corners.end(), [&](const auto& c) { return vertex[c.vertex] != 0; }))
        faces.push_back(f);
    }
  }
};

/// Two cores, and the nearest points known so far.
struct Pair {
  Core a, b;
  double scale = 0;  // length to which round-off is relative, m
  Near near_a, near_b;
  double nearest = infinity;       // m
  Vector on_a{}, on_b{}, apart{};  // apart = on_b − on_a

  void set(const Shape& shape_a, const Pose& at_a, const Shape& shape_b, const Pose& at_b) {
    const Matrix3<double> back = at_a.rotation.transpose();
    const Matrix3<double> turn = back * at_b.rotation;
    const Vector offset = back * (at_b.position - at_a.position);
    if (!std::isfinite(turn.sum()) || !(offset.squaredNorm() < 1e200)) {
      throw std::invalid_argument("sat: a pose is not finite, or the shapes are more than 1e100 m apart");
    }
    a.set(shape_a, Matrix3<double>::Identity(), Vector::Zero());
    b.set(shape_b, turn, offset);
    scale = 0;
    for (const Core* core : {&a, &b}) {
      // Room for either in either place: a scene that changes a little needs no more.
      for (Core* place : {&a, &b}) {
        place->vertices.reserve(core->vertices.size());
        place->normals.reserve(core->normals.size());
      }
      near_a.reserve(*core);
      near_b.reserve(*core);
      for (const Vector& v : core->vertices) scale = std::max(scale, v.cwiseAbs().maxCoeff());
    }
  }

  double gap(const Vector& n) const { return b.lowest(n) - a.highest(n); }

  Axis best_axis() const {
    Axis best;
    const auto take = [&](double separation, const Vector& n) {
      if (separation > best.separation) best = {separation, n};
    };
    for (std::uint32_t f = 0; f < a.normals.size(); ++f) take(b.lowest(a.normals[f]) - a.height(f), a.normals[f]);
    for (std::uint32_t f = 0; f < b.normals.size(); ++f) take(-b.height(f) - a.highest(-b.normals[f]), -b.normals[f]);
    for (const Polytope::Edge& e : a.edges) {
      const Vector u = a.along(e);
      for (const Polytope::Edge& f : b.edges) take_edges(e, u, f, best);
    }
    return best;
  }

  /// The points nearest to each other, found among all that n, along which the gap is `separation`, does not exclude:
  /// the nearest points are no further inside, along n, than the distance is larger than the gap.
  void find_nearest(const Vector& n, double separation) {
    nearest = infinity;
    double least_a = -infinity, least_b = -infinity;
    if (std::isfinite(separation)) {
      const Vector& low = *std::min_element(b.vertices.begin(), b.vertices.end(),
                                            [&](const auto& x, const auto& y) { return n.dot(x) < n.dot(y); });
      const Vector& high = *std::max_element(a.vertices.begin(), a.vertices.end(),
                                             [&](const auto& x, const auto& y) { return n.dot(x) < n.dot(y); });
      const double inside = std::max((low - high).norm() - separation, 0.0) + 100 * round_off * scale;
      least_a = n.dot(high) - inside;
      least_b = -n.dot(low) - inside;
    }
    near_a.set(a, n, least_a);
    near_b.set(b, -n, least_b);
    for (const std::uint32_t e : near_a.edges) {
      for (const std::uint32_t f : near_b.edges) offer_edges(a.edges[e], b.edges[f]);
    }
    offer_faces(a, near_a, b, near_b, 1);
    offer_faces(b, near_b, a, near_a, -1);
  }

 private:
  /// The product of edges e of A and f of B, if it may be further than the best. Left and right face of an edge are the
  /// ends of its arc on the Gauss map; those of B are turned round. The arcs cross if the ends of each lie on both
  /// sides of the other's circle, and on the same half of the ball. The arc of a segment is its whole circle.
  void take_edges(const Polytope::Edge& e, const Vector& u, const Polytope::Edge& f, Axis& best) const {
    const Vector v = b.along(f);
    const auto both_sides = [](double x, double y, double length) {
      return std::min(x, y) <= generous * length && std::max(x, y) >= -generous * length;
    };
    Vector outward = Vector::Zero();
    double left_b = 0, right_a = 0;
    if (!b.flat()) {
      left_b = -b.normals[f.left].dot(u);
      const double length = u.norm();
      if (!both_sides(left_b, -b.normals[f.right].dot(u), length)) return;
      if (std::abs(left_b) <= generous * length) left_b = 0;
      outward -= b.normals[f.left] + b.normals[f.right];
    }
    if (!a.flat()) {
      right_a = a.normals[e.right].dot(v);
      const double length = v.norm();
      if (!both_sides(a.normals[e.left].dot(v), right_a, length)) return;
      if (std::abs(right_a) <= generous * length) right_a = 0;
      outward += a.normals[e.left] + a.normals[e.right];
    }
    if (left_b * right_a < 0) return;
    const Vector product = accurate_cross(u, v);
    const double length = product.norm();
    if (!(length > parallel * u.norm() * v.norm())) return;
    Vector n = product / length;
    const Vector between = b.vertices[f.from] - a.vertices[e.from];
    if (n.dot(a.flat() && b.flat() ? between : outward) < 0) n = -n;
    // An edge axis that is a face normal but for round-off does not take its place.
    const double wanted = best.separation + round_off * scale;
    if (n.dot(between) <= wanted) return;
    const double separation = gap(n);
    if (separation > wanted) best = {separation, n};
  }

  double as_near() const { return 1e-13 * nearest + 0.5 * round_off * scale; }

  /// Offers a pair of points. If two pairs are equally near up to round-off, their difference may be any direction
  /// close to the normal; the direction with the larger gap between the projections is then chosen, since a normal
  /// maximises it.
  void offer(const Vector& x, const Vector& y, const Vector& difference) {
    const double d = difference.stableNorm(), slack = as_near();
    if (!(d <= nearest + slack)) return;
    if (nearest < infinity && d >= nearest - slack &&
        !(gap(difference.stableNormalized()) > gap(apart.stableNormalized())))
      return;
    nearest = d;
    on_a = x;
    on_b = y;
    apart = difference;
  }

  /// Ends of each against the other, and the points where both lines are nearest: in the plane across the longer edge
  /// that one is a point and the other a line, which may be short, however nearly parallel they are.
  void offer_edges(const Polytope::Edge& e, const Polytope::Edge& f) {
    const Vector &p = a.vertices[e.from], &q = b.vertices[f.from];
    const Vector u = a.along(e), v = b.along(f);
    const double uu = u.squaredNorm(), vv = v.squaredNorm();
    const auto share = [](const Vector& x, const Vector& line, double square) {
      return square > 0 ? std::clamp(x.dot(line) / square, 0.0, 1.0) : 0.0;
    };
    // The difference is perpendicular to a line between its ends, however near: what round-off leaves along the line is
    // taken off.
    const auto upright = [](const Vector& x, const Vector& line, double square, double at) {
      return at > 0 && at < 1 ? Vector(x - line * (x.dot(line) / square)) : x;
    };
    for (const std::uint32_t end : {f.from, f.to}) {
      const double s = share(b.vertices[end] - p, u, uu);
      const Vector x = p + s * u;
      offer(x, b.vertices[end], upright(b.vertices[end] - x, u, uu, s));
    }
    for (const std::uint32_t end : {e.from, e.to}) {
      const double t = share(a.vertices[end] - q, v, vv);
      const Vector y = q + t * v;
      offer(a.vertices[end], y, upright(y - a.vertices[end], v, vv, t));
    }
    const Vector product = accurate_cross(u, v);
    const double square = product.squaredNorm();
    if (!(square > parallel * parallel * uu * vv)) return;
    const Vector between = q - p;
    const bool along_u = uu >= vv;
    const Vector& line = along_u ? u : v;
    const double length = along_u ? uu : vv;
    const Vector across = (along_u ? v : u) - line * ((along_u ? v : u).dot(line) / length);
    const Vector from = between - line * (between.dot(line) / length);
    const double other = (along_u ? -from : from).dot(across) / across.squaredNorm();
    const double same = (along_u ? Vector(between + other * v) : Vector(other * u - between)).dot(line) / length;
    const double s = along_u ? same : other, t = along_u ? other : same;
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return;
    const Vector x = p + s * u, y = q + t * v;
    const Vector difference = upright(y - x, line, length, same),
                 straight = product * (product.dot(difference) / square);
    // If nearly parallel edges are well apart, the difference of the points gives a better direction than the product.
    offer(x, y, (difference - straight).norm() <= 2 * round_off * scale ? straight : difference);
  }

  /// Vertices of `other` over faces of `core`; sign: 1 if that is A.
  void offer_faces(const Core& core, const Near& near, const Core& other, const Near& near_other, double sign) {
    for (const std::uint32_t f : near.faces) {
      const Vector& n = core.normals[f];
      const double height = core.height(f);
      const auto corners = core.polytope->corners_of(f);
      for (std::uint32_t k = 0; k < other.vertices.size(); ++k) {
        if (!near_other.vertex[k]) continue;
        const Vector& x = other.vertices[k];
        const double above = n.dot(x) - height;
        if (above < -100 * round_off * scale || above > nearest + as_near()) continue;
        bool inside = true;
        for (std::size_t i = 0; i < corners.size() && inside; ++i) {
          const Vector& from = core.vertices[corners[i].vertex];
          const Vector side = core.vertices[corners[(i + 1) % corners.size()].vertex] - from;
          inside = n.cross(side).dot(x - from) >= 0;
        }
        if (!inside) continue;
        const Vector foot = x - above * n;
        if (sign > 0) {
          offer(foot, x, above * n);
        } else {
          offer(x, foot, -above * n);
        }
      }
    }
  }
};

/// The direction across both edges, if segments or points of A and B meet.
Vector across(const Pair& pair) {
  const Vector u = pair.a.along(pair.a.edges[0]), v = pair.b.along(pair.b.edges[0]);
  const Vector n = u.cross(v);
  if (n.norm() > parallel * u.norm() * v.norm()) return n.stableNormalized();
  const Vector& line = u.squaredNorm() > v.squaredNorm() ? u : v;
  return line.isZero(0) ? Vector(Vector::UnitX()) : Vector(line.unitOrthogonal());
}

Distance ordered_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  static thread_local Pair pair;  // its room is kept from one question to the next
  pair.set(a, at_a, b, at_b);
  const Axis axis = pair.a.flat() && pair.b.flat() ? Axis{} : pair.best_axis();
  Vector normal = axis.normal, shift = Vector::Zero();
  double distance = axis.separation;
  if (axis.normal.isZero(0) || axis.separation > 0) {
    pair.find_nearest(axis.normal, axis.separation);
    distance = std::max({axis.separation, pair.apart.stableNorm()});
    // The axis gives the better direction if the shapes touch up to round-off.
    const Vector towards = pair.apart.stableNormalized();
    if (axis.normal.isZero(0)) {
      normal = pair.nearest > 2 * round_off * pair.scale ? towards : across(pair);
    } else if (!pair.apart.isZero(0)) {
      const bool touch = (pair.apart - axis.separation * axis.normal).norm() <= 10 * round_off * pair.scale;
      if (!touch || pair.gap(towards) >= axis.separation - round_off * pair.scale) normal = towards;
    }
  } else {
    shift = -axis.separation * axis.normal;
    for (Vector& v : pair.b.vertices) v += shift;
    pair.find_nearest(axis.normal, 0);
  }
  Distance result;
  result.distance = distance - (pair.a.radius + pair.b.radius);
  result.normal = -(at_a.rotation * normal);
  result.on_a = at_a.to_world(pair.on_a + pair.a.radius * normal);
  result.on_b = at_a.to_world(pair.on_b - shift - pair.b.radius * normal);
  return result;
}

}  // namespace

bool has_separating_axes(const Shape& shape) {
  switch (shape.tag()) {
    case ShapeTag::sphere:
    case ShapeTag::capsule:
    case ShapeTag::box:
    case ShapeTag::convex_hull: return true;
    default: return false;
  }
}

Distance hulls_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  if (!exchanged(a, at_a, b, at_b)) return ordered_distance(a, at_a, b, at_b);
  const Distance d = ordered_distance(b, at_b, a, at_a);
  return {d.distance, -d.normal, d.on_b, d.on_a};
}

Distance above_half_space(const Shape& a, const Pose& at_a, const Shape& half_space, const Pose& at_half_space) {
  const auto& b = static_cast<const HalfSpace&>(half_space);
  const Vector n = at_half_space.rotation * b.normal();
  const Vector lowest = at_a.rotation * a.support(-(at_a.rotation.transpose() * n));
  const double distance = n.dot(at_a.position - at_half_space.position) + n.dot(lowest) - b.offset();
  if (!std::isfinite(distance)) throw std::invalid_argument("narrow phase: a pose is not finite");
  const Vector on_a = at_a.position + lowest;
  return {distance, n, on_a, on_a - distance * n};
}

}  // namespace polhode::collision::narrow
