// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/box_faces.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "collision/narrow/four.hpp"
#include "collision/narrow/patch.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

// The corners of a face lie at (−, −), (+, −), (−, +), (+, +) along its two axes, and its sides go from corner 0 to 1,
// 0 to 2, 1 to 3 and 2 to 3: both as the box numbers its vertices and edges.
constexpr Four sign_x{-1, 1, -1, 1}, sign_y{-1, -1, 1, 1};
inline Four starts(Four corners) { return __builtin_shufflevector(corners, corners, 0, 0, 1, 2); }
inline Four ends(Four corners) { return __builtin_shufflevector(corners, corners, 1, 2, 3, 3); }

/// Numbers of a face's parts: four vertices, four edges, itself.
struct Parts {
  std::uint8_t number[9];
};
constexpr Parts parts_of(std::uint32_t face) {
  const std::uint32_t axis = face / 2, p = axis == 0 ? 1 : 0, q = axis == 2 ? 1 : 2, high = face % 2 << axis;
  const std::uint32_t v[4] = {high, high | 1u << p, high | 1u << q, high | 1u << p | 1u << q};
  const std::uint32_t all[9] = {
      v[0], v[1], v[2], v[3], edge_from[v[0]][p], edge_from[v[0]][q], edge_from[v[1]][q], edge_from[v[2]][p], face};
  Parts parts{};
  for (int k = 0; k < 9; ++k) parts.number[k] = std::uint8_t(all[k]);
  return parts;
}
constexpr Parts parts[6] = {parts_of(0), parts_of(1), parts_of(2), parts_of(3), parts_of(4), parts_of(5)};

/// Kinds of points of the patch, sorted by features: a corner of the reference face, a corner of the incident face, a
/// crossing of a side of each.
constexpr int kinds_of_point = 24;
struct Meeting {
  Feature::Kind kind, mirrored;
  std::uint8_t of_reference, of_incident;  // places in Parts
};
constexpr Meeting meeting(int k) {
  using enum Feature::Kind;
  if (k < 4) return {vertex_face, face_vertex, std::uint8_t(k), 8};
  if (k < 8) return {face_vertex, vertex_face, 8, std::uint8_t(k - 4)};
  return {edge_edge, edge_edge, std::uint8_t(4 + (k - 8) / 4), std::uint8_t(4 + (k - 8) % 4)};
}
constexpr auto meetings = [] {
  std::array<Meeting, kinds_of_point> all{};
  for (int k = 0; k < kinds_of_point; ++k) all[std::size_t(k)] = meeting(k);
  return all;
}();

/// The possible points of the patch: places along two axes of the reference box and heights above its face, m.
struct Points {
  double x[kinds_of_point], y[kinds_of_point], height[kinds_of_point];
};

/// Crossings of the sides of the incident face with the line of a reference side: position along it, and height.
struct Crossings {
  Four along, height;
  FourBits there;
};

/// `across` and `along` are the incident corners' coordinates; those `beyond` the line lie outside.
inline Crossings crossings(Four across, double line, FourBits beyond, Four along, Four height) {
  const Four from = starts(across), a = starts(along), h = starts(height);
  const Four share = larger(smaller((from - all(line)) / (from - ends(across)), all(1.0)), all(0.0));
  const FourBits there = FourBits(starts(Four(beyond))) ^ FourBits(ends(Four(beyond)));
  return {a + share * (ends(along) - a), h + share * (ends(height) - h), there};
}

/// The largest numbers of four registers.
inline Four largest_of_each(Four a, Four b, Four c, Four d) {
  const Four ab = larger(__builtin_shufflevector(a, b, 0, 4, 2, 6), __builtin_shufflevector(a, b, 1, 5, 3, 7));
  const Four cd = larger(__builtin_shufflevector(c, d, 0, 4, 2, 6), __builtin_shufflevector(c, d, 1, 5, 3, 7));
  return larger(__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
}

}  // namespace

bool faces_patch(const ReferenceFace& reference, const IncidentBox& incident, double margin, Manifold& manifold) {
  const int k = int(reference.face / 2), p = k == 0 ? 1 : 0, q = k == 2 ? 1 : 2;
  const double sign = reference.face % 2 == 1 ? 1 : -1;
  const Vector3<double>& half = reference.half;
  const Matrix3<double>& turn = incident.turn;
  const Vector3<double> towards =
      -sign * turn.row(k).transpose();  // vector into the reference box, in the incident box's axes
  const int axis = largest_component(towards), u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const std::uint32_t incident_face = face_along(towards, axis);

  // The corners of the incident face.
  const double out = std::copysign(incident.half[axis], towards[axis]);
  const Vector3<double> centre = incident.offset + out * turn.col(axis);
  const Four half_u = sign_x * all(incident.half[u]), half_v = sign_y * all(incident.half[v]);
  const auto corners = [&](int i) { return all(centre[i]) + (half_u * all(turn(i, u)) + half_v * all(turn(i, v))); };
  const Four x = corners(p), y = corners(q), height = all(sign) * corners(k) - all(half[k]);

  // Outside of a side is what is further beyond it than the tolerance.
  constexpr double relative_tolerance = 1e-6;
  const double tolerance = relative_tolerance * (half[p] + half[q]);
  const Four reach_x = all(half[p] + tolerance), reach_y = all(half[q] + tolerance);
  const FourBits left = x<-reach_x, right = x> reach_x, below = y<-reach_y, above = y> reach_y;
  const Crossings at_left = crossings(x, -half[p], left, y, height), at_right = crossings(x, half[p], right, y, height);
  const Crossings at_bottom = crossings(y, -half[q], below, x, height),
                  at_top = crossings(y, half[q], above, x, height);

  // A corner of the reference face is in the patch where the left or the right side is crossed beyond it and before it.
  // Then what crosses the other side lies beyond that corner, or within the side.
  const Four none = all(-std::numeric_limits<double>::infinity());
  const Four beyond = largest_of_each(at_left.there ? -at_left.along : none, at_right.there ? -at_right.along : none,
                                      at_left.there ? at_left.along : none, at_right.there ? at_right.along : none);
  const FourBits covered = (beyond > reach_y) & (-__builtin_shufflevector(beyond, beyond, 2, 3, 0, 1) <= all(half[q]));
  const Four limit = covered ? all(half[p]) : reach_x;
  const auto within = [](const Crossings& c, Four low, Four high) {
    return c.there & (c.along >= -low) & (c.along <= high);
  };

  const Four corner_x = sign_x * all(half[p]), corner_y = sign_y * all(half[q]);
  const double steep = 1 / turn(k, axis);
  const Four in_plane = all(sign) * (all(centre[k]) - (corner_x - all(centre[p])) * all(turn(p, axis) * steep) -
                                     (corner_y - all(centre[q])) * all(turn(q, axis) * steep)) -
                        all(half[k]);
  const Four corner_height =
      larger(in_plane, all(-highest(-height)));  // a corner may be off the incident face by the tolerance

  Points points;
  std::uint32_t there = 0, near = 0;
  const auto offer = [&](int first, Four at_x, Four at_y, Four at_height, FourBits is_there) {
    put(at_x, points.x + first);
    put(at_y, points.y + first);
    put(at_height, points.height + first);
    there |= bits(is_there) << first;
    near |= bits(is_there & (at_height <= all(margin))) << first;
  };
  offer(0, corner_x, corner_y, corner_height, covered);
  offer(4, x, y, height, ~(left | right | below | above));
  offer(8, at_bottom.along, all(-half[q]), at_bottom.height,
        within(at_bottom, __builtin_shufflevector(limit, limit, 0, 0, 0, 0),
               __builtin_shufflevector(limit, limit, 1, 1, 1, 1)));
  offer(12, all(-half[p]), at_left.along, at_left.height, within(at_left, reach_y, reach_y));
  offer(16, all(half[p]), at_right.along, at_right.height, within(at_right, reach_y, reach_y));
  offer(20, at_top.along, all(half[q]), at_top.height,
        within(at_top, __builtin_shufflevector(limit, limit, 2, 2, 2, 2),
               __builtin_shufflevector(limit, limit, 3, 3, 3, 3)));
  if (near == 0) return false;

  const bool rocking = std::abs(towards[axis]) >= cosine_of_rocking;
  std::array<std::uint32_t, kinds_of_point> taken;
  std::size_t count = 0;
  for (std::uint32_t rest = rocking ? there : near; rest != 0; rest &= rest - 1)
    taken[count++] = std::uint32_t(std::countr_zero(rest));
  std::array<std::uint32_t, Manifold::capacity> chosen{0, 1, 2, 3};
  if (count > 4) {
    Points packed;
    double scratch[kinds_of_point];
    for (std::size_t n = 0; n < count; ++n) {
      packed.x[n] = points.x[taken[n]];
      packed.y[n] = points.y[taken[n]];
      packed.height[n] = points.height[taken[n]];
    }
    count = choose_corners({packed.x, packed.y, packed.height, scratch, count}, chosen);
  }

  const Matrix3<double>& rotation = reference.pose.rotation;
  const Vector3<double> normal = sign * rotation.col(k), across_x = rotation.col(p), across_y = rotation.col(q);
  const Vector3<double> origin = reference.pose.position + half[k] * normal;
  const Parts &of_reference = parts[reference.face], &of_incident = parts[incident_face];
  manifold.count = count;
  manifold.normal = reference.of_b ? normal : Vector3<double>(-normal);
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint32_t number = taken[chosen[n]];
    const Meeting& m = meetings[number];
    const std::uint32_t one = of_reference.number[m.of_reference], other = of_incident.number[m.of_incident];
    const double h = points.height[number];
    ContactPoint& point = manifold.points[n];
    point.point = origin + points.x[number] * across_x + points.y[number] * across_y + 0.5 * h * normal;
    point.depth = -h;
    point.feature = reference.of_b ? Feature{m.mirrored, other, one} : Feature{m.kind, one, other};
  }
  return true;
}

}  // namespace polhode::collision::narrow
