// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/box_manifold.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/narrow/patch.hpp"

namespace polhode {
namespace {

/// Number of the edge that starts at a vertex along an axis upwards: edges are sorted by their two vertices.
constexpr std::uint32_t edge_from[8][3] = {{0, 1, 2}, {0, 3, 4}, {5, 1, 6}, {5, 3, 7}, {8, 9, 2}, {8, 10, 4}, {11, 9, 6}, {11, 10, 7}};

/// The corners of each face counter-clockwise seen from outside, and the axis along which the edge from each of them runs.
constexpr std::uint32_t face_corner[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
constexpr std::uint32_t edge_axis[6][4] = {{2, 1, 2, 1}, {1, 2, 1, 2}, {0, 2, 0, 2}, {2, 0, 2, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}};

Vector3<double> corner(const Vector3<double>& half, std::uint32_t k) {
  return {k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]};
}

/// The axis of the largest component.
int largest(const Vector3<double>& n) {
  const Vector3<double> m = n.cwiseAbs();
  return m[0] >= m[1] && m[0] >= m[2] ? 0 : m[1] >= m[2] ? 1 : 2;
}

std::uint32_t face_along(const Vector3<double>& n, int axis) { return std::uint32_t(2 * axis) + (n[axis] > 0 ? 1 : 0); }

/// The reference box's face `face` against what of the incident box looks at it. `turn` and `offset` are the incident
/// box's in the reference box's axes.
bool face_patch(const Vector3<double>& half, const Pose& pose, std::uint32_t face, const Vector3<double>& incident_half,
                const Matrix3<double>& turn, const Vector3<double>& offset, double margin, Manifold& manifold) {
  const int k = int(face / 2), u = (k + 1) % 3, v = (k + 2) % 3;
  const double sign = face % 2 == 1 ? 1 : -1;
  const Vector3<double> towards = -sign * turn.row(k).transpose();  // into the reference box, in the incident box's axes
  const int incident_axis = largest(towards);
  const std::uint32_t incident_face = face_along(towards, incident_axis);
  // x along axis u, y along sign · axis v: right-handed with the outward normal.
  std::array<PatchSide, 4> sides;
  for (std::uint32_t s = 0; s < 4; ++s) {
    const std::uint32_t from = face_corner[face][s], to = face_corner[face][(s + 1) % 4];
    const int across = edge_axis[face][s] == std::uint32_t(u) ? v : u;
    const double outwards = (from & to) >> across & 1 ? 1 : -1;
    sides[s] = {across == u ? outwards : 0, across == v ? outwards * sign : 0, half[across], edge_from[from][edge_axis[face][s]], from};
  }
  std::array<PatchCorner, 8> corners, buffer;
  for (std::uint32_t c = 0; c < 4; ++c) {
    const std::uint32_t vertex = face_corner[incident_face][c];
    const Vector3<double> at = offset + turn * corner(incident_half, vertex);
    corners[c] = {at[u], sign * at[v], sign * at[k] - half[k], {Feature::Kind::face_vertex, face, vertex}, false,
                  edge_from[vertex][edge_axis[incident_face][c]]};
  }
  constexpr double tolerance = 1e-6;
  const auto patch = clip_patch(sides, incident_face, tolerance * (half[u] + half[v]), corners, 4, buffer);
  const Vector3<double> normal = sign * pose.rotation.col(k);
  const PatchFrame frame{pose.position + half[k] * normal, pose.rotation.col(u), sign * pose.rotation.col(v), normal};
  double lowest = std::numeric_limits<double>::infinity();
  for (const PatchCorner& c : patch) lowest = std::min(lowest, c.height);
  if (!(lowest <= margin)) return false;
  const bool rocking = std::abs(towards[incident_axis]) >= cosine_of_rocking;
  take_patch(frame, patch, rocking ? std::numeric_limits<double>::infinity() : margin, manifold);
  manifold.normal = -normal;
  return true;
}

/// Two edges that cross: of each box the one that is furthest along the normal.
void edge_point(const RelativeBoxes& boxes, const Pose& pose, const BoxAxis& axis, Manifold& manifold) {
  const int i = (axis.index - 6) / 3, j = (axis.index - 6) % 3;
  const Vector3<double> in_b = boxes.b_in_a.transpose() * axis.normal;
  std::uint32_t of_a = 0, of_b = 0;
  for (int k = 0; k < 3; ++k) {
    if (k != i && axis.normal[k] > 0) of_a |= 1u << k;
    if (k != j && in_b[k] < 0) of_b |= 1u << k;
  }
  Vector3<double> a = corner(boxes.half_a, of_a), b = corner(boxes.half_b, of_b);
  a[i] = 0;
  b[j] = 0;
  const int y = (i + 1) % 3, z = (i + 2) % 3;
  const Vector3<double> along = boxes.b_in_a.col(j), centre = boxes.offset + boxes.b_in_a * b;
  const Vector3<double> between = centre - a;
  const double across = along[y] * along[y] + along[z] * along[z];
  const double s = std::clamp(-(between[y] * along[y] + between[z] * along[z]) / across, -boxes.half_b[j], boxes.half_b[j]);
  const Vector3<double> middle = centre + s * along - 0.5 * axis.separation * axis.normal;
  manifold.count = 1;
  manifold.normal = -(pose.rotation * axis.normal);
  manifold.points[0] = {pose.to_world(middle), -axis.separation,
                        {Feature::Kind::edge_edge, edge_from[of_a][i], edge_from[of_b][j]}};
}

/// What of a box a point on its surface is part of.
struct Part {
  int faces = 0;             // how many it lies on: 1 a face, 2 an edge, 3 a vertex
  int along = 0;             // axis of the edge, or of the face's normal
  std::uint32_t vertex = 0;  // bits as the box numbers its vertices

  Part(const BoxAt& box, const Vector3<double>& point) {
    constexpr double nearly = 1 - 1e-9;
    const Vector3<double> x = box.pose.to_body(point);
    int in = 0, on = 0;
    for (int k = 0; k < 3; ++k) {
      if (x[k] > 0) vertex |= 1u << k;
      const bool at_face = std::abs(x[k]) >= nearly * box.half[k];
      faces += at_face;
      (at_face ? on : in) = k;
    }
    along = faces == 1 ? on : in;
  }
  std::uint32_t face() const { return std::uint32_t(2 * along) + (vertex >> along & 1); }
  /// Of a vertex, the edge that is most nearly parallel to d.
  std::uint32_t edge(const BoxAt& box, const Vector3<double>& d) const {
    return edge_from[vertex & ~(1u << axis(box, d))][axis(box, d)];
  }

 private:
  int axis(const BoxAt& box, const Vector3<double>& d) const {
    return faces == 2 ? along : largest(box.pose.rotation.transpose() * d);
  }
};

/// Where neither faces nor edges that cross meet: the nearest points. An edge beside an edge is nearest at an end of one.
void nearest_point(const BoxAt& a, const BoxAt& b, const Distance& d, Manifold& manifold) {
  const Part of_a(a, d.on_a), of_b(b, d.on_b);
  Feature feature;
  if (of_a.faces == 3 && of_b.faces == 1) feature = {Feature::Kind::vertex_face, of_a.vertex, of_b.face()};
  if (of_a.faces == 1 && of_b.faces == 3) feature = {Feature::Kind::face_vertex, of_a.face(), of_b.vertex};
  if (std::min(of_a.faces, of_b.faces) == 2) {
    const Vector3<double> along = of_a.faces == 2 ? a.pose.rotation.col(of_a.along) : b.pose.rotation.col(of_b.along);
    feature = {Feature::Kind::edge_edge, of_a.edge(a, along), of_b.edge(b, along)};
  }
  manifold.count = 1;
  manifold.normal = d.normal;
  manifold.points[0] = {0.5 * (d.on_a + d.on_b), -d.distance, feature};
}

double separation_of_face_of_a(const RelativeBoxes& boxes, int k) {
  return std::abs(boxes.offset[k]) - boxes.half_a[k] - boxes.b_in_a.row(k).cwiseAbs().dot(boxes.half_b);
}
double separation_of_face_of_b(const RelativeBoxes& boxes, int k) {
  return std::abs(boxes.b_in_a.col(k).dot(boxes.offset)) - boxes.half_b[k] - boxes.b_in_a.col(k).cwiseAbs().dot(boxes.half_a);
}

Manifold ordered_manifold(const BoxAt& a, const BoxAt& b, double margin) {
  Manifold manifold;
  const RelativeBoxes boxes(a, b);
  const BoxAxis axis = best_axis(boxes, margin);
  if (axis.separation > margin) return manifold;
  const Vector3<double> in_b = boxes.b_in_a.transpose() * axis.normal;
  const int of_a = largest(axis.normal), of_b = largest(in_b);
  const bool faces = std::abs(axis.normal[of_a]) >= cosine_of_rocking && std::abs(in_b[of_b]) >= cosine_of_rocking;
  bool found = false;
  if (axis.index < 3 || (axis.index >= 6 && faces && separation_of_face_of_a(boxes, of_a) >= separation_of_face_of_b(boxes, of_b))) {
    found = face_patch(boxes.half_a, a.pose, face_along(axis.normal, of_a), boxes.half_b, boxes.b_in_a, boxes.offset, margin,
                       manifold);
  } else if (axis.index < 6 || faces) {
    found = face_patch(boxes.half_b, b.pose, face_along(-in_b, of_b), boxes.half_a, boxes.b_in_a.transpose(),
                       -(boxes.b_in_a.transpose() * boxes.offset), margin, manifold);
    mirror(manifold);
  } else if (axis.separation <= 0) {
    edge_point(boxes, a.pose, axis, manifold);
    return manifold;
  }
  if (found) return manifold;
  const Distance d = boxes_distance(a, b);
  if (d.distance > margin) return manifold;
  if (axis.index >= 6 && d.distance <= axis.separation * (1 + 1e-9)) {
    edge_point(boxes, a.pose, axis, manifold);
  } else {
    nearest_point(a, b, d, manifold);
  }
  return manifold;
}

}  // namespace

Manifold boxes_manifold(const BoxAt& a, const BoxAt& b, double margin) {
  const bool exchanged = !in_order(a, b);
  Manifold manifold = exchanged ? ordered_manifold(b, a, margin) : ordered_manifold(a, b, margin);
  if (exchanged) mirror(manifold);
  return manifold;
}

}  // namespace polhode
