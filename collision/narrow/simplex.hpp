// SPDX-License-Identifier: BSD-3-Clause
// The point of a simplex nearest to the origin, by signed volumes: the signs of barycentric coordinates decide which
// face contains the point, not differences of nearly equal numbers. Source: Montanari, Petrinic & Barbieri, Improving
// the GJK algorithm for faster and more reliable distance queries between convex objects, ACM Transactions on Graphics
// 36(3), 2017. Volumes and areas are taken about the newest corner, whose edges are short compared with the distance if
// the shapes are far apart.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "collision/narrow/minkowski_pair.hpp"

namespace polhode::inline collision::inline narrow {

/// Up to four corners in fixed slots. `used` has a bit for each slot; `weight` is the barycentric coordinate λ of the
/// nearest point Σ λ w.
struct Simplex {
  unsigned used = 0;
  std::array<MinkowskiCorner, 4> corners;
  std::array<double, 4> weight{};

  int count() const { return std::popcount(used); }
  Vector3<double> on_a() const {
    return blend([](const MinkowskiCorner& c) -> const Vector3<double>& { return c.a; });
  }
  Vector3<double> turned_on_b() const {
    return blend([](const MinkowskiCorner& c) -> const Vector3<double>& { return c.turned_b; });
  }

 private:
  template <class F>
  Vector3<double> blend(const F& f) const {
    Vector3<double> sum = Vector3<double>::Zero();
    for (unsigned left = used; left != 0; left &= left - 1) {
      const auto i = std::size_t(std::countr_zero(left));
      sum += weight[i] * f(corners[i]);
    }
    return sum;
  }
};

/// The nearest point of a simplex; `used` are the corners that it depends on.
struct NearestPoint {
  Vector3<double> v = Vector3<double>::Zero();
  double square = 0;  ///< |v|²
  unsigned used = 0;
  bool inside = false;  ///< the origin is within the tetrahedron
  bool sure = false;    ///< the origin is inside by more than round-off
};

/// One step of iterative refinement of the barycentric coordinates of three corners, so that they give the projection
/// of x on their plane to the last digit even for a thin triangle: the residual is small, and is split like the whole.
inline void refine(const MinkowskiCorner& s0, const MinkowskiCorner& s1, const MinkowskiCorner& p,
                   const Vector3<double>& x, std::array<double, 4>& share) {
  const Vector3<double> e0 = edge(p, s0), e1 = edge(p, s1), n = e0.cross(e1);
  const Vector3<double> missed = share[0] * (s0.w - x) + share[1] * (s1.w - x) + share[2] * (p.w - x);
  const double nn = n.squaredNorm();
  const double d0 = missed.dot(n.cross(e1)) / nn, d1 = missed.dot(e0.cross(n)) / nn;
  const std::array<double, 3> better = {share[0] + d0, share[1] + d1, share[2] - d0 - d1};
  if (!(std::min({better[0], better[1], better[2]}) >= 0)) return;
  std::copy(better.begin(), better.end(), share.begin());
}

class SignedVolumes {
 public:
  using Corner = Vector3<double>;

  /// Keeps the nearest of all candidate points; i, j, k are the slots of their corners, whose coordinates go to
  /// `weight`.
  SignedVolumes(NearestPoint& nearest, std::array<double, 4>& weight) : nearest_(nearest), weight_(weight) {
    nearest.square = std::numeric_limits<double>::infinity();
    nearest.inside = false;
  }

  void point(const Corner& s, unsigned i) {
    const double square = s.squaredNorm();
    if (!(square < nearest_.square)) return;
    take(s, square, 1u << i);
    weight_[i] = 1;
  }

  void segment(const Corner& s, const Corner& p, unsigned i, unsigned j) {
    const Vector3<double> t = s - p;
    const double along = -p.dot(t), length = t.squaredNorm();
    if (!(along > 0)) return point(p, j);
    if (!(along < length)) return point(s, i);
    // Computed from the nearer end, where less cancellation occurs.
    const double u = along / length;
    const Vector3<double> v = u < 0.5 ? Vector3<double>(p + u * t) : Vector3<double>(s - (s.dot(t) / length) * t);
    const double square = v.squaredNorm();
    if (!(square < nearest_.square)) return;
    take(v, square, 1u << i | 1u << j);
    weight_[i] = u;
    weight_[j] = 1 - u;
  }

  void triangle(const Corner& s0, const Corner& s1, const Corner& p, unsigned i, unsigned j, unsigned k) {
    const Vector3<double> e0 = s0 - p, e1 = s1 - p;
    triangle(s0, s1, p, e0, e1, e0.cross(e1), i, j, k);
  }

  /// Barycentric coordinates of the origin: four volumes over the whole volume.
  void tetrahedron(const Corner& s0, const Corner& s1, const Corner& s2, const Corner& p, unsigned i, unsigned j,
                   unsigned k, unsigned l) {
    const Vector3<double> e0 = s0 - p, e1 = s1 - p, e2 = s2 - p;
    const Vector3<double> n0 = e1.cross(e2), n1 = e2.cross(e0), n2 = e0.cross(e1);
    const double side = e0.dot(n0), sign = std::copysign(1.0, side), whole = std::abs(side);
    const double b0 = -sign * p.dot(n0), b1 = -sign * p.dot(n1), b2 = -sign * p.dot(n2), b3 = whole - (b0 + b1 + b2);
    bool in0 = b0 > 0, in1 = b1 > 0, in2 = b2 > 0, in3 = b3 > 0;
    if (in0 & in1 & in2 & in3) {
      const double square = std::max({s0.squaredNorm(), s1.squaredNorm(), s2.squaredNorm(), p.squaredNorm()});
      const double rounding = 32 * std::numeric_limits<double>::epsilon() * square * std::sqrt(square);
      if (whole > rounding) {
        take(Vector3<double>::Zero(), 0, 1u << i | 1u << j | 1u << k | 1u << l);
        weight_[i] = b0 / whole;
        weight_[j] = b1 / whole;
        weight_[k] = b2 / whole;
        weight_[l] = b3 / whole;
        nearest_.inside = true;
        nearest_.sure = std::min({b0, b1, b2, b3}) > rounding;
        return;
      }
      in0 = in1 = in2 = in3 = false;  // too flat to hold anything: one of its faces is as near
    }
    if (!in0) triangle(s1, s2, p, e1, e2, n0, j, k, l);
    if (!in1) triangle(s2, s0, p, e2, e0, n1, k, i, l);
    if (!in2) triangle(s0, s1, p, e0, e1, n2, i, j, l);
    if (!in3) triangle(s0, s1, s2, i, j, k);
  }

 private:
  /// e0, e1: the edges from p, n: their product. The coordinates are areas of the triangles between the sides and the
  /// projection of the origin on the plane.
  void triangle(const Corner& s0, const Corner& s1, const Corner& p, const Vector3<double>& e0,
                const Vector3<double>& e1, const Vector3<double>& n, unsigned i, unsigned j, unsigned k) {
    const double nn = n.squaredNorm();
    const double c0 = p.dot(n.cross(e1)), c1 = p.dot(e0.cross(n)), c2 = nn - (c0 + c1);
    if ((c0 > 0) & (c1 > 0) & (c2 > 0)) {
      const double height = p.dot(n), square = height * (height / nn);
      if (!(square < nearest_.square)) return;
      take(n * (height / nn), square, 1u << i | 1u << j | 1u << k);
      weight_[i] = c0 / nn;
      weight_[j] = c1 / nn;
      weight_[k] = c2 / nn;
      return;
    }
    if (!(c0 > 0)) segment(s1, p, j, k);
    if (!(c1 > 0)) segment(s0, p, i, k);
    if (!(c2 > 0)) segment(s0, s1, i, j);
  }

  void take(const Vector3<double>& v, double square, unsigned used) {
    for (int axis = 0; axis < 3; ++axis) nearest_.v[axis] = v[axis];  // one by one, so that the next step need not wait
    nearest_.square = square;
    nearest_.used = used;
  }

  NearestPoint& nearest_;
  std::array<double, 4>& weight_;
};

/// The nearest point of all corners in use, and its coordinates.
inline void solve(Simplex& s, unsigned newest, NearestPoint& nearest) {
  SignedVolumes volumes(nearest, s.weight);
  const auto w = [&](unsigned i) -> const Vector3<double>& { return s.corners[i].w; };
  unsigned left = s.used & ~(1u << newest);
  const auto next = [&left] {
    const auto i = unsigned(std::countr_zero(left));
    left &= left - 1;
    return i;
  };
  switch (s.count()) {
    case 1: return volumes.point(w(newest), newest);
    case 2: {
      const unsigned i = next();
      return volumes.segment(w(i), w(newest), i, newest);
    }
    case 3: {
      const unsigned i = next(), j = next();
      return volumes.triangle(w(i), w(j), w(newest), i, j, newest);
    }
    default: {
      const unsigned i = next(), j = next(), k = next();
      return volumes.tetrahedron(w(i), w(j), w(k), w(newest), i, j, k, newest);
    }
  }
}

}  // namespace polhode::collision::narrow
