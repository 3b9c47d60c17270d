// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/box_sat.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "collision/narrow/four.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

constexpr double round_off = 5e-16;    // rounding error of a separation, in units of RelativeBoxes::scale
constexpr double parallel = 1e-15;     // sine of an angle below which two edges span no axis that others do not
constexpr double nearly_best = 1e-12;  // margin, in the same units, of an edge axis that may hold the nearest points

/// Gap between the projections of the boxes on n; n is a unit vector in A's axes, from A to B.
double shadow_gap(const RelativeBoxes& boxes, const Vector3<double>& offset, const Vector3<double>& n) {
  return n.dot(offset) - n.cwiseAbs().dot(boxes.half_a) - (boxes.b_in_a.transpose() * n).cwiseAbs().dot(boxes.half_b);
}

/// The nearest points known so far, in A's axes. Of two pairs of points that are as near, but for round-off, the
/// difference may point anywhere that is nearly upright; then that one counts on which the shadows are further apart,
/// as a normal must have it.
struct Nearest {
  const RelativeBoxes& boxes;
  const Vector3<double>& offset;
  double distance = std::numeric_limits<double>::infinity();  // m
  Vector3<double> on_a{}, on_b{}, apart{};                    // apart = on_b − on_a

  double gap(const Vector3<double>& difference) const { return shadow_gap(boxes, offset, difference.normalized()); }

  void offer(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& difference) {
    const double d = difference.norm(), as_near = 1e-13 * d + round_off * boxes.scale;
    if (!(d <= distance + as_near)) return;
    if (d >= distance - as_near && !(gap(difference) > gap(apart))) return;
    distance = d;
    on_a = a;
    on_b = b;
    apart = difference;
  }
};

Vector3<double> corner(const Vector3<double>& half, int k) {
  return {k & 1 ? half[0] : -half[0], k & 2 ? half[1] : -half[1], k & 4 ? half[2] : -half[2]};
}

Vector3<double> clamped(const Vector3<double>& x, const Vector3<double>& half) {
  return x.cwiseMax(-half).cwiseMin(half);
}

/// Each vertex of one against the whole of the other: right wherever one of the nearest points is a vertex. A
/// coordinate that is not clamped leaves an exact zero, so the direction stands exactly upright on the face or edge
/// that it meets.
void offer_vertices(const RelativeBoxes& boxes, const Vector3<double>& offset, Nearest& nearest) {
  for (int k = 0; k < 8; ++k) {
    const Vector3<double> b = offset + boxes.b_in_a * corner(boxes.half_b, k);
    const Vector3<double> a = clamped(b, boxes.half_a);
    nearest.offer(a, b, b - a);
  }
  for (int k = 0; k < 8; ++k) {
    const Vector3<double> a = corner(boxes.half_a, k);
    const Vector3<double> in_b = boxes.b_in_a.transpose() * (a - offset);
    const Vector3<double> b = clamped(in_b, boxes.half_b);
    nearest.offer(a, offset + boxes.b_in_a * b, boxes.b_in_a * (b - in_b));
  }
}

/// Two edges, of A along its axis i with centre `a` and of B along its axis j with centre `b`, where both nearest
/// points lie within them. In the plane across A's edge that edge is a point and B's a short line, however nearly
/// parallel they are.
void offer_edges(const RelativeBoxes& boxes, int i, int j, const Vector3<double>& a, const Vector3<double>& b,
                 const Vector3<double>& normal, Nearest& nearest) {
  const int y = (i + 1) % 3, z = (i + 2) % 3;
  const Vector3<double> along = boxes.b_in_a.col(j);
  const Vector3<double> between = b - a;
  const double across = along[y] * along[y] + along[z] * along[z];
  const double reach_b = boxes.half_b[j], reach_a = boxes.half_a[i];
  const double best = -(between[y] * along[y] + between[z] * along[z]) / across;
  const double u = std::clamp(best, -reach_b, reach_b);
  Vector3<double> difference = between + u * along;
  const double x = std::clamp(difference[i], -reach_a, reach_a);
  const bool both_within = u == best && x == difference[i];
  difference[i] -= x;
  // If nearly parallel edges are well apart, the difference of the points gives a better direction than the product.
  const Vector3<double> straight = normal * difference.dot(normal);
  if (both_within && (difference - straight).norm() <= 4 * round_off * boxes.scale) difference = straight;
  Vector3<double> on_a = a;
  on_a[i] = x;
  nearest.offer(on_a, b + u * along, difference);
}

/// The edge pairs that may be nearest along the axis of edges i and j: on each box the edge that is furthest along the
/// normal, and both where the normal stands upright on a face that has them.
void offer_edge_pairs(const RelativeBoxes& boxes, const Vector3<double>& offset, int i, int j,
                      const Vector3<double>& normal, Nearest& nearest) {
  constexpr double upright = 1e-7;
  const Vector3<double> in_b = boxes.b_in_a.transpose() * normal;
  const auto possible = [](double component, double sign) { return component * sign > -upright; };
  for (int k = 0; k < 4; ++k) {
    const double first = k & 1 ? 1 : -1, second = k & 2 ? 1 : -1;
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    if (!possible(normal[y], first) || !possible(normal[z], second)) continue;
    Vector3<double> a = Vector3<double>::Zero();
    a[y] = first * boxes.half_a[y];
    a[z] = second * boxes.half_a[z];
    for (int m = 0; m < 4; ++m) {
      const double third = m & 1 ? 1 : -1, fourth = m & 2 ? 1 : -1;
      const int v = (j + 1) % 3, w = (j + 2) % 3;
      if (!possible(in_b[v], -third) || !possible(in_b[w], -fourth)) continue;
      const Vector3<double> b =
          offset + boxes.b_in_a.col(v) * (third * boxes.half_b[v]) + boxes.b_in_a.col(w) * (fourth * boxes.half_b[w]);
      offer_edges(boxes, i, j, a, b, normal, nearest);
    }
  }
}

/// The relative rotation, three entries side by side.
struct Sides {
  Four row[3], magnitude[3];  // the rows, and their magnitudes

  explicit Sides(const Matrix3<double>& c) {
    for (int i = 0; i < 3; ++i) {
      row[i] = Four{c(i, 0), c(i, 1), c(i, 2), c(i, 2)};
      magnitude[i] = absolute(row[i]);
    }
  }
};

/// The products of edges that are not parallel, and along which the separation may be `wanted` or more: bit 3i + j for
/// edge i of A and edge j of B. The separation times the length of the product is compared, squared with its sign,
/// three products at a time.
std::uint32_t possible_edges(const RelativeBoxes& boxes, const Sides& sides, double wanted) {
  const Four half_b = three(boxes.half_b), half_next = next(half_b), half_after = after_next(half_b);
  std::uint32_t possible = 0;
  for (int i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    const Four along = absolute(all(boxes.offset[z]) * sides.row[y] - all(boxes.offset[y]) * sides.row[z]);
    const Four reach_a = all(boxes.half_a[y]) * sides.magnitude[z] + all(boxes.half_a[z]) * sides.magnitude[y];
    const Four reach_b = half_next * after_next(sides.magnitude[i]) + half_after * next(sides.magnitude[i]);
    const Four squared = sides.row[y] * sides.row[y] + sides.row[z] * sides.row[z];
    const Four most = along - (reach_a + reach_b) + all(12 * round_off * boxes.scale);
    const FourBits enough = FourBits(most * absolute(most) >= all(wanted * std::abs(wanted)) * squared);
    possible |= (bits(enough & FourBits(squared >= all(parallel * parallel))) & 7) << 3 * i;
  }
  return possible;
}

/// The product of edge i of A and edge j of B is number 3i + j.
BoxAxis edge_axis(const RelativeBoxes& boxes, int number) {
  const Matrix3<double>& c = boxes.b_in_a;
  const int i = number / 3, j = number % 3;
  const int y = (i + 1) % 3, z = (i + 2) % 3, v = (j + 1) % 3, w = (j + 2) % 3;
  const double length = std::sqrt(c(y, j) * c(y, j) + c(z, j) * c(z, j));
  const double ny = -c(z, j) / length, nz = c(y, j) / length;
  const double along = boxes.offset[y] * ny + boxes.offset[z] * nz;
  const double reach_a = boxes.half_a[y] * std::abs(ny) + boxes.half_a[z] * std::abs(nz);
  const double reach_b =
      boxes.half_b[v] * std::abs(c(y, v) * ny + c(z, v) * nz) + boxes.half_b[w] * std::abs(c(y, w) * ny + c(z, w) * nz);
  const double sign = std::copysign(1.0, along);
  BoxAxis axis{6 + number, std::abs(along) - reach_a - reach_b, Vector3<double>::Zero()};
  axis.normal[y] = sign * ny;
  axis.normal[z] = sign * nz;
  return axis;
}

/// The distance of boxes that the axis `best` separates, or just touches after `offset` was moved so that they do.
Nearest nearest_points(const RelativeBoxes& boxes, const Vector3<double>& offset, const BoxAxis& best) {
  Nearest nearest{boxes, offset};
  const double wanted = best.separation - nearly_best * boxes.scale;
  for (std::uint32_t left = possible_edges(boxes, Sides(boxes.b_in_a), wanted); left != 0; left &= left - 1) {
    const BoxAxis axis = edge_axis(boxes, std::countr_zero(left));
    if (axis.separation < wanted) continue;
    // A product may point either way if the boxes have the same centre; such boxes were moved apart along `best`.
    const Vector3<double> normal = axis.normal.dot(best.normal) < 0 ? Vector3<double>(-axis.normal) : axis.normal;
    offer_edge_pairs(boxes, offset, (axis.index - 6) / 3, (axis.index - 6) % 3, normal, nearest);
  }
  offer_vertices(boxes, offset, nearest);
  return nearest;
}

Distance ordered_distance(const BoxAt& a, const BoxAt& b) {
  const RelativeBoxes boxes(a, b);
  const BoxAxis axis = best_axis(boxes);
  Distance result;
  result.distance = axis.separation;
  Vector3<double> normal = axis.normal;
  const bool apart = axis.separation > 0;
  const Vector3<double> shift = apart ? Vector3<double>::Zero() : Vector3<double>(-axis.separation * axis.normal);
  const Vector3<double> offset = boxes.offset + shift;
  const Nearest nearest = nearest_points(boxes, offset, axis);
  if (apart) {
    result.distance = std::max(axis.separation, nearest.distance);
    // The axis gives the better direction if the boxes touch up to round-off.
    const bool touch = (nearest.apart - axis.separation * axis.normal).norm() <= 20 * round_off * boxes.scale;
    const bool known =
        nearest.distance > 0 && (!touch || nearest.gap(nearest.apart) >= axis.separation - round_off * boxes.scale);
    if (known) normal = nearest.apart.normalized();
  }
  result.normal = -(a.pose.rotation * normal);
  result.on_a = a.pose.to_world(nearest.on_a);
  result.on_b = a.pose.to_world(nearest.on_b - shift);
  return result;
}

}  // namespace

RelativeBoxes::RelativeBoxes(const BoxAt& a, const BoxAt& b)
    : half_a(a.half),
      half_b(b.half),
      b_in_a(a.pose.rotation.transpose() * b.pose.rotation),
      offset(a.pose.rotation.transpose() * (b.pose.position - a.pose.position)),
      scale(half_a.sum() + half_b.sum() + offset.cwiseAbs().sum()) {}

bool in_order(const BoxAt& a, const BoxAt& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.pose.position[k] != b.pose.position[k]) return a.pose.position[k] < b.pose.position[k];
  }
  for (int k = 0; k < 3; ++k) {
    if (a.half[k] != b.half[k]) return a.half[k] < b.half[k];
  }
  for (int k = 0; k < 9; ++k) {
    const double of_a = a.pose.rotation(k % 3, k / 3), of_b = b.pose.rotation(k % 3, k / 3);
    if (of_a != of_b) return of_a < of_b;
  }
  return true;
}

BoxAxis best_axis(const RelativeBoxes& boxes, double enough) {
  if (!std::isfinite(boxes.scale) || !std::isfinite(boxes.b_in_a.sum())) {
    throw std::invalid_argument("narrow phase: the pose of a box is not finite");
  }
  const Matrix3<double>& c = boxes.b_in_a;
  const Vector3<double>& t = boxes.offset;
  const Sides sides(c);
  Four reach_a = three(boxes.half_a), reach_b = three(boxes.half_b), along_b{};
  for (int k = 0; k < 3; ++k) {
    reach_a += absolute(three(c.col(k))) * all(boxes.half_b[k]);
    reach_b += sides.magnitude[k] * all(boxes.half_a[k]);
    along_b += sides.row[k] * all(t[k]);
  }
  static constexpr double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Four of_a = absolute(three(t)) - reach_a, of_b = absolute(along_b) - reach_b;
  const double separation = std::max(largest(of_a), largest(of_b));
  const std::uint32_t of_faces_a = bits(FourBits(of_a == all(separation))) & 7,
                      of_faces_b = bits(FourBits(of_b == all(separation)));
  const int k = std::countr_zero(of_faces_a | of_faces_b << 3);
  const bool a_face = k < 3;
  const Vector3<double> axis(a_face ? unit[k] : c.data() + 3 * (k - 3));
  BoxAxis best{k, separation, axis * std::copysign(1.0, a_face ? t[k] : along_b[k - 3])};
  if (best.separation > enough) return best;
  // An edge axis that is a face normal but for round-off does not take its place.
  for (std::uint32_t left = possible_edges(boxes, sides, best.separation); left != 0; left &= left - 1) {
    const BoxAxis edges = edge_axis(boxes, std::countr_zero(left));
    if (edges.separation > best.separation + round_off * boxes.scale) best = edges;
  }
  return best;
}

Distance boxes_distance(const BoxAt& a, const BoxAt& b) {
  if (in_order(a, b)) return ordered_distance(a, b);
  Distance mirrored = ordered_distance(b, a);
  mirrored.normal = -mirrored.normal;
  std::swap(mirrored.on_a, mirrored.on_b);
  return mirrored;
}

}  // namespace polhode::collision::narrow
