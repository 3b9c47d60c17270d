// SPDX-License-Identifier: BSD-3-Clause
// The rotation of q/|q| is one of whole numbers over |q|². Lengths are counted in units of 2^-k / (|qa|² |qb|²), with
// which every vertex is a whole number.
#include "tests/collision/narrow/exact_boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/collision/narrow/whole_numbers.hpp"

namespace polhode {
namespace exact_boxes {
namespace {

/// The rotation as |q|² times its columns, in units of q's last bit.
struct WholeRotation {
  std::array<Whole3, 3> axis;
  Whole squared;  // |q|²

  explicit WholeRotation(const Quaternion<double>& q) {
    const int unit = last_bit_of_all(q);
    const Whole w = whole(q[0], unit), x = whole(q[1], unit), y = whole(q[2], unit), z = whole(q[3], unit);
    axis[0] = {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
    axis[1] = {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
    axis[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
    squared = w * w + x * x + y * y + z * z;
  }
};

struct WholeBox {
  std::array<Whole3, 3> axis;  ///< axes, each of length `squared`
  Whole squared;
  std::array<Whole3, 3> edge;  ///< half an edge
  std::array<Whole, 3> reach;  ///< half an edge · its axis
  Whole3 centre;
};

/// A vertex of one and the whole of the other: squared distance over squared², in units.
long double vertex_distance(const WholeBox& box, const Whole3& vertex) {
  const Whole3 from_centre = vertex - box.centre;
  Whole sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Whole along = magnitude(dot(from_centre, box.axis[k]));
    if (along <= box.reach[k]) continue;
    const Whole beyond = along - box.reach[k];
    sum += beyond * beyond;
  }
  return std::sqrt(rounded(sum)) / rounded(box.squared);
}

Whole3 vertex(const WholeBox& box, unsigned k) {
  Whole3 v = box.centre;
  for (std::size_t i = 0; i < 3; ++i) v = k >> i & 1 ? v + box.edge[i] : v - box.edge[i];
  return v;
}

/// The distance of the edges, if both nearest points of the lines lie within the edges and it is less than `least`.
long double edge_distance(const WholeBox& a, std::size_t i, unsigned p, const WholeBox& b, std::size_t j, unsigned q,
                          const Whole3& normal, const Whole& normal_squared, long double length, long double least) {
  const std::size_t y = (i + 1) % 3, z = (i + 2) % 3, v = (j + 1) % 3, w = (j + 2) % 3;
  Whole3 between = b.centre - a.centre;
  between = p & 1 ? between - a.edge[y] : between + a.edge[y];
  between = p & 2 ? between - a.edge[z] : between + a.edge[z];
  between = q & 1 ? between + b.edge[v] : between - b.edge[v];
  between = q & 2 ? between + b.edge[w] : between - b.edge[w];
  const long double distance = std::abs(rounded(dot(between, normal))) / length;
  if (distance >= least) return least;
  // between + s edge_b = t edge_a + a multiple of the normal, with the normal that of the axes: edge = f axis.
  const Whole s = -dot(cross(between, a.axis[i]), normal), t = -dot(cross(between, b.axis[j]), normal);
  // Parameters are in units of the axes; half an edge is reach / squared² of its axis.
  const auto within = [&](const Whole& parameter, const WholeBox& box, std::size_t k) {
    return magnitude(parameter) * box.squared * box.squared <= box.reach[k] * normal_squared;
  };
  return within(s, b, j) && within(t, a, i) ? distance : least;
}

struct Pair {
  WholeBox a, b;
  long double unit;  ///< m

  Pair(const ExactBox& first, const ExactBox& second) {
    int last = no_bits;
    for (const ExactBox* box : {&first, &second})
      last = last_bit_of_all(box->half, last_bit_of_all(box->position, last));
    const WholeRotation of_a(first.orientation), of_b(second.orientation);
    const Whole both = of_a.squared * of_b.squared;
    fill(a, first, of_a, of_b.squared, both, last);
    fill(b, second, of_b, of_a.squared, both, last);
    unit = std::ldexp(1.0L, last) / rounded(both);
  }

  static void fill(WholeBox& box, const ExactBox& from, const WholeRotation& rotation, const Whole& other,
                   const Whole& both, int last) {
    box.axis = rotation.axis;
    box.squared = rotation.squared;
    for (std::size_t k = 0; k < 3; ++k) {
      box.edge[k] = rotation.axis[k] * (whole(from.half[int(k)], last) * other);
      box.reach[k] = dot(box.edge[k], box.axis[k]);
      box.centre[k] = whole(from.position[int(k)], last) * both;
    }
  }
};

long double distance_apart(const Pair& pair) {
  const auto& [a, b, unit] = pair;
  long double least = std::numeric_limits<long double>::infinity();
  for (unsigned k = 0; k < 8; ++k) {
    least = std::min({least, vertex_distance(a, vertex(b, k)), vertex_distance(b, vertex(a, k))});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Whole3 normal = cross(a.axis[i], b.axis[j]);
      const Whole squared = dot(normal, normal);
      if (squared == 0) continue;
      const long double length = std::sqrt(rounded(squared));
      for (unsigned p = 0; p < 4; ++p) {
        for (unsigned q = 0; q < 4; ++q) least = edge_distance(a, i, p, b, j, q, normal, squared, length, least);
      }
    }
  }
  return least * unit;
}

}  // namespace
}  // namespace exact_boxes

ExactDistance exact_distance(const ExactBox& first, const ExactBox& second) {
  using namespace exact_boxes;
  const Pair pair(first, second);
  const WholeBox &a = pair.a, &b = pair.b;
  const Whole3 between = b.centre - a.centre;
  ExactDistance result{-1, -std::numeric_limits<long double>::infinity()};
  const auto take = [&](const Whole3& axis, long double length) {
    Whole separation = magnitude(dot(between, axis));
    for (const WholeBox* box : {&a, &b}) {
      for (std::size_t k = 0; k < 3; ++k) separation -= magnitude(dot(box->edge[k], axis));
    }
    result.sign = std::max(result.sign, separation.sign());
    result.distance = std::max(result.distance, rounded(separation) / length * pair.unit);
  };
  for (const WholeBox* box : {&a, &b}) {
    for (const Whole3& axis : box->axis) take(axis, rounded(box->squared));
  }
  for (const Whole3& of_a : a.axis) {
    for (const Whole3& of_b : b.axis) {
      const Whole3 axis = cross(of_a, of_b);
      const Whole squared = dot(axis, axis);
      if (squared != 0) take(axis, std::sqrt(rounded(squared)));
    }
  }
  if (result.sign > 0) result.distance = distance_apart(pair);
  return result;
}

}  // namespace polhode
