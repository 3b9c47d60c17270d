// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/box_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "collision/narrow/box_faces.hpp"
#include "collision/narrow/patch.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

Vector3<double> corner(const Vector3<double>& half, std::uint32_t k) {
  return {k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]};
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
  const double s =
      std::clamp(-(between[y] * along[y] + between[z] * along[z]) / across, -boxes.half_b[j], boxes.half_b[j]);
  const Vector3<double> middle = centre + s * along - 0.5 * axis.separation * axis.normal;
  manifold.count = 1;
  manifold.normal = -(pose.rotation * axis.normal);
  manifold.points[0] = {
      pose.to_world(middle), -axis.separation, {Feature::Kind::edge_edge, edge_from[of_a][i], edge_from[of_b][j]}};
}

/// The feature of a box that a point on its surface belongs to.
struct Part {
  int faces = 0;             // number of faces on which the point lies: 1 a face, 2 an edge, 3 a vertex
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
  /// The edge of the vertex that is most nearly parallel to d.
  std::uint32_t edge(const BoxAt& box, const Vector3<double>& d) const {
    return edge_from[vertex & ~(1u << axis(box, d))][axis(box, d)];
  }

 private:
  int axis(const BoxAt& box, const Vector3<double>& d) const {
    return faces == 2 ? along : largest_component(box.pose.rotation.transpose() * d);
  }
};

/// The contact at the nearest points, if neither faces nor crossing edges meet. For two adjacent edges the nearest
/// point is an end of one of them.
void nearest_point(const BoxAt& a, const BoxAt& b, const Distance& d, Manifold& manifold) {
  const Part of_a(a, d.on_a), of_b(b, d.on_b);
  Feature feature{Feature::Kind::other, 0, 0};
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
  return std::abs(boxes.b_in_a.col(k).dot(boxes.offset)) - boxes.half_b[k] -
         boxes.b_in_a.col(k).cwiseAbs().dot(boxes.half_a);
}

Manifold ordered_manifold(const BoxAt& a, const BoxAt& b, double margin) {
  Manifold manifold;
  const RelativeBoxes boxes(a, b);
  const BoxAxis axis = best_axis(boxes, margin);
  if (axis.separation > margin) return manifold;
  const Vector3<double> in_b = boxes.b_in_a.transpose() * axis.normal;
  const int of_a = largest_component(axis.normal), of_b = largest_component(in_b);
  const bool faces = std::abs(axis.normal[of_a]) >= cosine_of_rocking && std::abs(in_b[of_b]) >= cosine_of_rocking;
  // Faces that touch, but for round-off, are near.
  constexpr double round_off = 2e-15;
  const double near = margin + round_off * boxes.scale;
  bool found = false;
  if (axis.index < 3 ||
      (axis.index >= 6 && faces && separation_of_face_of_a(boxes, of_a) >= separation_of_face_of_b(boxes, of_b))) {
    found = faces_patch({boxes.half_a, a.pose, face_along(axis.normal, of_a), false},
                        {boxes.half_b, boxes.b_in_a, boxes.offset}, near, manifold);
  } else if (axis.index < 6 || faces) {
    const Matrix3<double> turn = boxes.b_in_a.transpose();
    const Vector3<double> offset = -(turn * boxes.offset);
    found = faces_patch({boxes.half_b, b.pose, face_along(-in_b, of_b), true}, {boxes.half_a, turn, offset}, near,
                        manifold);
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

}  // namespace polhode::collision::narrow
