// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "collision/narrow/pair_order.hpp"
#include "collision/narrow/patch.hpp"
#include "collision/narrow/support_feature.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/half_space.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

using Kind = SupportFeature::Kind;
using Corner = SupportFeature::Corner;

constexpr std::uint32_t end_of_edge = 1u << 31;
constexpr double parallel = 1e-5;   // distance by which edges side by side part, across the normal, over their length
constexpr double as_deep = 1e-3;    // excess of depth, over the least, up to which a normal is as good
constexpr double round_off = 1e-9;  // rounding error, over the size of a face

/// Buffers that are filled anew for each pair.
struct Scratch {
  SupportFeature of_a, of_b, incident;
  std::vector<PatchSide> sides;
  std::vector<PatchCorner> corners, buffer;
};

Scratch& scratch() {
  thread_local Scratch s;
  return s;
}

/// A face in the axes of its shape, and where its sides are. A half-space has none.
struct Reference {
  PatchFrame frame;
  std::uint32_t face = 0;
  double size = 0;  ///< quarter of the perimeter, m
};

/// Two axes beside a unit vector, right-handed with it.
void set_axes(PatchFrame& frame, const Vector3<double>& along) {
  frame.x = (along - along.dot(frame.normal) * frame.normal).normalized();
  frame.y = frame.normal.cross(frame.x);
}

Reference reference_of(const SupportFeature& f, std::vector<PatchSide>& sides) {
  Reference r;
  r.face = f.face;
  r.frame.normal = f.normal;
  r.frame.origin = f.corners[0].at;
  for (const Corner& c : f.corners) {
    const double above = f.normal.dot(c.at - r.frame.origin);
    if (above > 0) r.frame.origin += above * f.normal;
  }
  set_axes(r.frame, f.corners[1].at - f.corners[0].at);
  sides.clear();
  for (std::size_t k = 0; k < f.corners.size(); ++k) {
    const Corner &from = f.corners[k], &to = f.corners[k + 1 == f.corners.size() ? 0 : k + 1];
    const Vector3<double> along = to.at - from.at, place = from.at - r.frame.origin;
    const double dx = along.dot(r.frame.x), dy = along.dot(r.frame.y), length = std::hypot(dx, dy);
    const double nx = dy / length, ny = -dx / length;
    sides.push_back({nx, ny, nx * place.dot(r.frame.x) + ny * place.dot(r.frame.y), from.edge, from.vertex});
    r.size += 0.25 * length;
  }
  return r;
}

/// The part of a segment over the reference face; its ends are in `corners`. Returns how many points are left.
std::size_t clip_segment(std::span<const PatchSide> sides, double tolerance, std::vector<PatchCorner>& corners) {
  const PatchCorner a = corners[0], b = corners[1];
  double from = 0, to = 1;
  std::size_t first = sides.size(), last = sides.size();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const PatchSide& side = sides[s];
    const double at_a = side.nx * a.x + side.ny * a.y - side.offset, at_b = side.nx * b.x + side.ny * b.y - side.offset;
    if (at_a > tolerance && at_b > tolerance) return 0;
    if ((at_a > tolerance) == (at_b > tolerance)) continue;
    const double cut = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    if (at_a > tolerance && cut > from) from = cut, first = s;
    if (at_b > tolerance && cut < to) to = cut, last = s;
  }
  if (from > to) return 0;
  const auto cut = [&](double share, std::size_t side, PatchCorner& c) {
    if (side == sides.size()) return;
    c.x = a.x + share * (b.x - a.x);
    c.y = a.y + share * (b.y - a.y);
    c.height = a.height + share * (b.height - a.height);
    c.feature = {Feature::Kind::edge_edge, sides[side].edge, a.edge};
  };
  cut(from, first, corners[0]);
  cut(to, last, corners[1]);
  return from == to ? 1 : 2;
}

/// Clips the feature of the incident shape that faces the reference face. `turn` and `offset` place it in the reference
/// shape's axes. The features of the manifold list the reference shape first. Returns false if nothing is left that is
/// near enough, or if the rest is less deep than `depth`.
bool against_face(const Reference& reference, const Pose& pose, const Shape& incident, const Matrix3<double>& turn,
                  const Vector3<double>& offset, double margin, double depth, Manifold& manifold) {
  Scratch& s = scratch();
  const PatchFrame& frame = reference.frame;
  support_feature(incident, -(turn.transpose() * frame.normal), s.incident);
  s.corners.clear();
  for (const Corner& c : s.incident.corners) {
    const Vector3<double> at = offset + turn * c.at - frame.origin;
    s.corners.push_back({at.dot(frame.x),
                         at.dot(frame.y),
                         at.dot(frame.normal),
                         {Feature::Kind::face_vertex, reference.face, c.vertex},
                         false,
                         c.edge});
  }
  const double tolerance = 1e-6 * reference.size;
  std::span<PatchCorner> patch;
  if (s.incident.kind == Kind::face) {
    const std::size_t count = s.corners.size();
    s.corners.resize(count + 2 * s.sides.size());
    s.buffer.resize(s.corners.size());
    patch = clip_patch(s.sides, s.incident.face, tolerance, s.corners, count, s.buffer);
  } else if (s.incident.kind == Kind::edge) {
    patch = std::span(s.corners).first(clip_segment(s.sides, tolerance, s.corners));
  } else {
    const PatchCorner& c = s.corners[0];
    const bool outside = std::any_of(s.sides.begin(), s.sides.end(), [&](const PatchSide& side) {
      return side.nx * c.x + side.ny * c.y - side.offset > tolerance;
    });
    patch = std::span(s.corners).first(outside ? 0 : 1);
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (const PatchCorner& c : patch) lowest = std::min(lowest, c.height);
  if (!(lowest <= margin) || (depth >= 0 && -lowest < depth - round_off * (reference.size + depth))) return false;
  const PatchFrame in_world{pose.to_world(frame.origin), pose.rotation * frame.x, pose.rotation * frame.y,
                            pose.rotation * frame.normal};
  take_patch(in_world, patch, manifold);
  manifold.normal = -in_world.normal;
  return true;
}

struct Placed {
  const Shape& shape;
  const Pose& pose;
};

/// Distance of the other shape beyond the plane of a face.
double separation(const SupportFeature& face, const Placed& of, const Placed& other) {
  const Vector3<double> n = of.pose.rotation * face.normal;
  const Vector3<double> nearest = other.pose.rotation * other.shape.support(-(other.pose.rotation.transpose() * n));
  double highest = -std::numeric_limits<double>::infinity();
  for (const Corner& c : face.corners) highest = std::max(highest, face.normal.dot(c.at));
  return n.dot(other.pose.position - of.pose.position) + n.dot(nearest) - highest;
}

bool on_face(const SupportFeature& face, const Placed& of, const Placed& other, double margin, double depth,
             Manifold& manifold) {
  const Reference reference = reference_of(face, scratch().sides);
  const Matrix3<double> back = of.pose.rotation.transpose();
  return against_face(reference, of.pose, other.shape, back * other.pose.rotation,
                      back * (other.pose.position - of.pose.position), margin, depth, manifold);
}

/// Edges side by side: the two ends of what they share, if it has any length.
bool side_by_side(const SupportFeature& ea, const Placed& a, const SupportFeature& eb, const Placed& b,
                  const Distance& d, Manifold& manifold) {
  const Vector3<double> from_a = a.pose.rotation * ea.corners[0].at, from_b = b.pose.rotation * eb.corners[0].at;
  const Vector3<double> u = a.pose.rotation * ea.corners[1].at - from_a,
                        v = b.pose.rotation * eb.corners[1].at - from_b;
  if (std::abs(d.normal.dot(u.cross(v))) > parallel * u.norm() * v.norm() ||
      std::abs(u.dot(v)) < 0.5 * u.norm() * v.norm())
    return false;
  const Vector3<double> between = (b.pose.position - a.pose.position) + (from_b - from_a);
  // Ends as shares of A's edge.
  const double length = u.squaredNorm(), start = between.dot(u) / length, end = start + v.dot(u) / length;
  const std::size_t low = start <= end ? 0 : 1;
  const double low_b = std::min(start, end), high_b = std::max(start, end);
  struct End {
    double share;
    Feature feature;
  };
  const auto of_a = [&](std::size_t k) {
    return Feature{Feature::Kind::other, ea.corners[k].vertex | end_of_edge, eb.corners[0].edge};
  };
  const auto of_b = [&](std::size_t k) {
    return Feature{Feature::Kind::other, ea.corners[0].edge, eb.corners[k].vertex | end_of_edge};
  };
  const End first = low_b > 0 ? End{low_b, of_b(low)} : End{0, of_a(0)};
  const End last = high_b < 1 ? End{high_b, of_b(1 - low)} : End{1, of_a(1)};
  if (!((last.share - first.share) * std::sqrt(length) > 1e-6 * std::min(std::sqrt(length), v.norm()))) return false;
  double deepest = -std::numeric_limits<double>::infinity();
  manifold.count = 0;
  manifold.normal = d.normal;
  for (const End& e : {first, last}) {
    const Vector3<double> on_a = from_a + e.share * u;
    const Vector3<double> on_b =
        from_b + (e.share - start) * length / v.dot(u) * v + (b.pose.position - a.pose.position);
    const double depth = -d.normal.dot(on_a - on_b);
    deepest = std::max(deepest, depth);
    manifold.points[manifold.count++] = {a.pose.position + 0.5 * (on_a + on_b), depth, e.feature};
  }
  return deepest >= -d.distance - round_off * (std::sqrt(length) + std::abs(d.distance));
}

/// The nearest points, named by what the shapes turn towards each other.
void nearest_points(const SupportFeature& a, const SupportFeature& b, const Distance& d, Manifold& manifold) {
  const auto number = [](const SupportFeature& f) {
    return f.kind == Kind::face ? f.face : f.kind == Kind::edge ? f.corners[0].edge : f.corners[0].vertex;
  };
  Feature feature{Feature::Kind::other, number(a), number(b)};
  if (a.kind == Kind::edge && b.kind == Kind::edge) feature.kind = Feature::Kind::edge_edge;
  if (a.kind == Kind::point && b.kind == Kind::face) feature.kind = Feature::Kind::vertex_face;
  if (a.kind == Kind::face && b.kind == Kind::point) feature.kind = Feature::Kind::face_vertex;
  manifold.count = 1;
  manifold.normal = d.normal;
  manifold.points[0] = {0.5 * (d.on_a + d.on_b), -d.distance, feature};
}

Manifold against_half_space(const Placed& a, const Placed& floor, double margin) {
  Manifold manifold;
  const auto& half_space = static_cast<const HalfSpace&>(floor.shape);
  Reference reference;
  scratch().sides.clear();
  const Vector3<double>& n = half_space.normal();
  // Near the other shape, so that its points are as exact as itself.
  const Matrix3<double> back = floor.pose.rotation.transpose();
  const Vector3<double> offset = back * (a.pose.position - floor.pose.position);
  reference.frame.normal = n;
  reference.frame.origin = offset - (n.dot(offset) - half_space.offset()) * n;
  Eigen::Index least;
  n.cwiseAbs().minCoeff(&least);
  set_axes(reference.frame, Vector3<double>::Unit(least));
  against_face(reference, floor.pose, a.shape, back * a.pose.rotation, offset, margin, -1, manifold);
  mirror(manifold);
  return manifold;
}

Manifold ordered_patch(const Placed& a, const Placed& b, const Distance& d, double margin) {
  const bool plane_a = a.shape.tag() == ShapeTag::half_space, plane_b = b.shape.tag() == ShapeTag::half_space;
  Manifold manifold;
  if (plane_a && plane_b) {
    nearest_points({Kind::face, 0, {}, {}}, {Kind::face, 0, {}, {}}, d, manifold);
    return manifold;
  }
  if (plane_b) return against_half_space(a, b, margin);
  if (plane_a) {
    manifold = against_half_space(b, a, margin);
    mirror(manifold);
    return manifold;
  }
  SupportFeature &fa = scratch().of_a, &fb = scratch().of_b;
  support_feature(a.shape, -(a.pose.rotation.transpose() * d.normal), fa);
  support_feature(b.shape, b.pose.rotation.transpose() * d.normal, fb);
  const bool faces = fa.kind == Kind::face && fb.kind == Kind::face;
  const double none = -std::numeric_limits<double>::infinity();
  const double beyond_a = fa.kind == Kind::face ? separation(fa, a, b) : none;
  const double beyond_b = fb.kind == Kind::face ? separation(fb, b, a) : none;
  const double enough = d.distance - as_deep * std::abs(d.distance);
  const bool a_first = beyond_a >= beyond_b;
  for (const bool reference_a : {a_first, !a_first}) {
    const double beyond = reference_a ? beyond_a : beyond_b;
    const SupportFeature& face = reference_a ? fa : fb;
    if (face.kind != Kind::face) continue;
    double size = 0;
    for (const Corner& c : face.corners) size = std::max(size, (c.at - face.corners[0].at).norm());
    if (!faces && beyond < enough - round_off * size) continue;
    // Faces that rock may overhang, and then the patch is less deep than the furthest corner is.
    const double depth = faces ? -d.distance : -beyond;
    if (reference_a) {
      if (on_face(fa, a, b, margin, depth, manifold)) return manifold;
    } else if (on_face(fb, b, a, margin, depth, manifold)) {
      mirror(manifold);
      return manifold;
    }
  }
  if (fa.kind == Kind::edge && fb.kind == Kind::edge && side_by_side(fa, a, fb, b, d, manifold)) return manifold;
  nearest_points(fa, fb, d, manifold);
  return manifold;
}

/// The manifold of a part of A and one of B.
struct PartPatch {
  Manifold manifold;
  std::uint32_t part_a = 0, part_b = 0;
  double depth = 0;  ///< depth of the deepest point, m
};

std::size_t count_of_parts(const Shape& shape) {
  return shape.tag() == ShapeTag::compound ? static_cast<const Compound&>(shape).parts().size() : 1;
}
const Shape& part_of(const Shape& shape, std::size_t k) {
  return shape.tag() == ShapeTag::compound ? *static_cast<const Compound&>(shape).parts()[k] : shape;
}

std::span<const PartPatch> patches_of_parts(const NarrowPhase& phase, const Shape& a, const Pose& at_a, const Shape& b,
                                            const Pose& at_b, double margin) {
  thread_local std::vector<PartPatch> patches;
  patches.clear();
  const Bounds near_b = [&] {
    Bounds bounds = b.bounds(at_b);
    return Bounds(bounds.min().array() - margin, bounds.max().array() + margin);
  }();
  for (std::uint32_t i = 0; i < count_of_parts(a); ++i) {
    const Shape& part_a = part_of(a, i);
    const Bounds bounds = part_a.bounds(at_a);
    if (!bounds.intersects(near_b)) continue;
    const Bounds near_a(bounds.min().array() - margin, bounds.max().array() + margin);
    for (std::uint32_t j = 0; j < count_of_parts(b); ++j) {
      const Shape& part_b = part_of(b, j);
      if (!part_b.bounds(at_b).intersects(near_a)) continue;
      PartPatch p{phase.manifold(part_a, at_a, part_b, at_b, margin), i, j};
      if (p.manifold.count == 0) continue;
      p.depth = p.manifold.points[0].depth;
      for (std::size_t k = 1; k < p.manifold.count; ++k) p.depth = std::max(p.depth, p.manifold.points[k].depth);
      patches.push_back(p);
    }
  }
  return patches;
}

/// One manifold of several, with the normal of the deepest.
Manifold joined_patch(std::span<const PartPatch> patches) {
  Manifold joined;
  const auto deeper = [](const PartPatch& p, const PartPatch& q) { return p.depth > q.depth; };
  const auto deepest = std::min_element(patches.begin(), patches.end(), deeper);
  if (deepest == patches.end()) return joined;
  const Vector3<double>& n = deepest->manifold.normal;
  joined.normal = n;
  PatchFrame frame{deepest->manifold.points[0].point, {}, {}, -n};
  Eigen::Index least;
  n.cwiseAbs().minCoeff(&least);
  set_axes(frame, Vector3<double>::Unit(least));
  thread_local std::vector<ContactPoint> points;
  std::vector<PatchCorner>& corners = scratch().corners;
  points.clear();
  corners.clear();
  constexpr std::uint32_t numbers = 1u << 16;
  for (const PartPatch& p : patches) {
    const double cosine = p.manifold.normal.dot(n);
    if (cosine < cosine_of_rocking) continue;
    for (std::size_t k = 0; k < p.manifold.count; ++k) {
      ContactPoint point = p.manifold.points[k];
      point.depth /= cosine;
      point.feature.of_a += numbers * p.part_a;
      point.feature.of_b += numbers * p.part_b;
      const Vector3<double> at = point.point - frame.origin;
      corners.push_back(
          {at.dot(frame.x), at.dot(frame.y), -point.depth, point.feature, false, std::uint32_t(points.size())});
      points.push_back(point);
    }
  }
  for (const PatchCorner& c : those_that_matter(corners)) joined.points[joined.count++] = points[c.edge];
  return joined;
}

}  // namespace

Manifold contact_patch(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, const Distance& d,
                       double margin) {
  if (!(d.distance <= margin)) return {};
  if (!exchanged(a, at_a, b, at_b)) return ordered_patch({a, at_a}, {b, at_b}, d, margin);
  Manifold manifold = ordered_patch({b, at_b}, {a, at_a}, {d.distance, -d.normal, d.on_b, d.on_a}, margin);
  mirror(manifold);
  return manifold;
}

Manifold compound_patch(const NarrowPhase& phase, const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                        double margin) {
  for (const Pose* at : {&at_a, &at_b}) {
    if (at->position.allFinite() && at->rotation.allFinite()) continue;
    throw std::invalid_argument("the manifold of a compound needs poses that are finite");
  }
  if (!exchanged(a, at_a, b, at_b)) return joined_patch(patches_of_parts(phase, a, at_a, b, at_b, margin));
  Manifold manifold = joined_patch(patches_of_parts(phase, b, at_b, a, at_a, margin));
  mirror(manifold);
  return manifold;
}

}  // namespace polhode::collision::narrow
