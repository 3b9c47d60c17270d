// SPDX-License-Identifier: BSD-3-Clause
// The point of a simplex that is nearest to the origin, by signed volumes: which of its faces holds the point is told by
// the signs of barycentric coordinates, not by differences of nearly equal numbers.
// Source: Montanari, Petrinic & Barbieri, Improving the GJK algorithm for faster and more reliable distance queries
// between convex objects, ACM Transactions on Graphics 36(3), 2017.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "collision/narrow/minkowski_pair.hpp"

namespace polhode {

/// The nearest point Σ λ_i w_i; those of the corners with λ > 0 that it needs.
struct NearestPoint {
  Vector3<double> v = Vector3<double>::Zero();
  double square = 0;  ///< |v|²
  int count = 0;
  std::array<int, 4> kept{};
  std::array<double, 4> weight{};
  bool inside = false;  ///< the origin is within the tetrahedron,
  bool sure = false;    ///< and further from its faces than rounding reaches
};

class SignedVolumes {
 public:
  using Corner = Vector3<double>;

  static NearestPoint point(const Corner& s, int i) { return {s, s.squaredNorm(), 1, {i}, {1.0}, false, false}; }

  static NearestPoint segment(const Corner& s0, const Corner& s1, int i, int j) {
    const Vector3<double> t = s1 - s0;
    const double along = -s0.dot(t), length = t.squaredNorm();
    if (!(along > 0)) return point(s0, i);
    if (!(along < length)) return point(s1, j);
    // From the nearer end, where less cancels.
    const double u = along / length;
    const Vector3<double> v = u < 0.5 ? Vector3<double>(s0 + u * t) : Vector3<double>(s1 + (s1.dot(t) / -length) * t);
    return {v, v.squaredNorm(), 2, {i, j}, {1 - u, u}, false, false};
  }

  static NearestPoint triangle(const Corner& s0, const Corner& s1, const Corner& s2, int i, int j, int k) {
    const Vector3<double> n = (s1 - s0).cross(s2 - s0);
    const double nn = n.squaredNorm();
    // Signed areas of the triangles that the origin's projection makes with the sides, on the plane where most is seen.
    int axis = 0;
    if (std::abs(n[1]) > std::abs(n[axis])) axis = 1;
    if (std::abs(n[2]) > std::abs(n[axis])) axis = 2;
    if (nn > 0) {
      const Vector3<double> v = n * (s0.dot(n) / nn);
      const int x = axis == 2 ? 0 : axis + 1, y = axis == 0 ? 2 : axis - 1;  // the next two, in cyclic order
      const auto area = [&](const Corner& a, const Corner& b) {
        return (a[x] - v[x]) * (b[y] - v[y]) - (a[y] - v[y]) * (b[x] - v[x]);
      };
      const double whole = n[axis];
      const double c0 = area(s1, s2) / whole, c1 = area(s2, s0) / whole, c2 = area(s0, s1) / whole;
      if (c0 > 0 && c1 > 0 && c2 > 0) {
        const double sum = c0 + c1 + c2;
        return {v, v.squaredNorm(), 3, {i, j, k}, {c0 / sum, c1 / sum, c2 / sum}, false, false};
      }
      NearestPoint best;
      best.square = -1;
      if (!(c0 > 0)) better(best, segment(s1, s2, j, k));
      if (!(c1 > 0)) better(best, segment(s0, s2, i, k));
      if (!(c2 > 0)) better(best, segment(s0, s1, i, j));
      return best;
    }
    NearestPoint best = segment(s0, s1, i, j);
    better(best, segment(s0, s2, i, k));
    better(best, segment(s1, s2, j, k));
    return best;
  }

  static NearestPoint tetrahedron(const Corner& s0, const Corner& s1, const Corner& s2, const Corner& s3) {
    const Vector3<double> c23 = s2.cross(s3), c01 = s0.cross(s1);
    const double b0 = s1.dot(c23), b1 = -s0.dot(c23), b2 = s3.dot(c01), b3 = -s2.dot(c01);
    const double whole = b0 + b1 + b2 + b3;
    const double sign = whole < 0 ? -1 : 1;
    bool in0 = b0 * sign > 0, in1 = b1 * sign > 0, in2 = b2 * sign > 0, in3 = b3 * sign > 0;
    if (in0 && in1 && in2 && in3) {
      const double square = std::max({s0.squaredNorm(), s1.squaredNorm(), s2.squaredNorm(), s3.squaredNorm()});
      const double rounding = 32 * std::numeric_limits<double>::epsilon() * square * std::sqrt(square);
      if (std::abs(whole) > rounding) {
        const bool sure = std::min({b0 * sign, b1 * sign, b2 * sign, b3 * sign}) > rounding;
        return {Vector3<double>::Zero(), 0, 4, {0, 1, 2, 3}, {b0 / whole, b1 / whole, b2 / whole, b3 / whole}, true, sure};
      }
      in0 = in1 = in2 = in3 = false;  // too flat to hold anything: one of its faces is as near
    }
    NearestPoint best;
    best.square = -1;
    if (!in0) better(best, triangle(s1, s2, s3, 1, 2, 3));
    if (!in1) better(best, triangle(s0, s2, s3, 0, 2, 3));
    if (!in2) better(best, triangle(s0, s1, s3, 0, 1, 3));
    if (!in3) better(best, triangle(s0, s1, s2, 0, 1, 2));
    return best;
  }

 private:
  static void better(NearestPoint& best, const NearestPoint& other) {
    if (best.square < 0 || other.square < best.square) best = other;
  }
};

}  // namespace polhode
