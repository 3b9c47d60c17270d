// SPDX-License-Identifier: BSD-3-Clause
// GJK: the point of A ⊖ B nearest to the origin, by simplices of its corners.
// Sources: Gilbert, Johnson & Keerthi, IEEE Journal of Robotics and Automation 4(2), 1988; the sub-algorithm of
// Montanari et al. 2017 (simplex.hpp); the stop where a corner comes back, van den Bergen, Journal of Graphics Tools
// 4(2), 1999.
#pragma once

#include <algorithm>
#include <limits>

#include "collision/narrow/simplex.hpp"

namespace polhode {

struct Simplex {
  int count = 0;
  std::array<MinkowskiCorner, 4> corners;
  std::array<double, 4> weight{};

  Vector3<double> on_a() const { return blend([](const MinkowskiCorner& c) { return c.a; }); }
  Vector3<double> on_b() const { return blend([](const MinkowskiCorner& c) { return c.b; }); }

 private:
  template <class F>
  Vector3<double> blend(const F& f) const {
    Vector3<double> sum = weight[0] * f(corners[0]);
    for (int i = 1; i < count; ++i) sum += weight[std::size_t(i)] * f(corners[std::size_t(i)]);
    return sum;
  }
};

struct GjkResult {
  enum class State {
    apart,     ///< v is the nearest point
    separated, ///< some direction separates; asked only whether they overlap
    near,      ///< the origin is in the difference, or so near that rounding hides on which side
    inside,    ///< the origin is within a tetrahedron of the difference, further than rounding reaches
  };
  State state = State::near;
  Vector3<double> v = Vector3<double>::Zero();
  double distance = 0;  ///< |v|
  double scale = 0;     ///< the largest |w| met
  int iterations = 0;
  Simplex simplex;
};

/// Round-off of a corner, as a share of the largest: below `near_share` of it the sign of a distance is not trusted.
inline constexpr double near_share = 1e-13;
inline constexpr double stop_share = 16 * std::numeric_limits<double>::epsilon();
inline constexpr int gjk_limit = 100, stall_limit = 10;

/// From the simplex given, which may be empty. With `early` it stops at the first direction that separates.
template <bool early>
GjkResult gjk_loop(const MinkowskiPair& pair, const Simplex& start) {
  GjkResult r;
  NearestPoint nearest;
  std::array<MinkowskiCorner, 4>& corner = r.simplex.corners;
  const auto solve = [&](int count) {
    switch (count) {
      case 1: nearest = SignedVolumes::point(corner[0].w, 0); break;
      case 2: nearest = SignedVolumes::segment(corner[0].w, corner[1].w, 0, 1); break;
      case 3: nearest = SignedVolumes::triangle(corner[0].w, corner[1].w, corner[2].w, 0, 1, 2); break;
      default: nearest = SignedVolumes::tetrahedron(corner[0].w, corner[1].w, corner[2].w, corner[3].w);
    }
  };
  const auto keep = [&] {
    for (int i = 0; i < nearest.count; ++i) {
      corner[std::size_t(i)] = corner[std::size_t(nearest.kept[std::size_t(i)])];
      r.simplex.weight[std::size_t(i)] = nearest.weight[std::size_t(i)];
    }
    r.simplex.count = nearest.count;
    r.v = nearest.v;
  };

  double scale2 = 0;
  if (start.count > 0) {
    r.simplex = start;
  } else {
    r.simplex.count = 1;
    corner[0] = pair.support(pair.offset.isZero(0) ? Vector3<double>(1, 0, 0) : pair.offset);
  }
  for (int i = 0; i < r.simplex.count; ++i) scale2 = std::max(scale2, corner[std::size_t(i)].w.squaredNorm());
  solve(r.simplex.count);
  keep();
  double square = nearest.square;
  int stalls = 0;

  for (r.iterations = 1; !nearest.inside && r.iterations <= gjk_limit; ++r.iterations) {
    if (square <= near_share * near_share * scale2) break;
    const int count = r.simplex.count;
    MinkowskiCorner& next = corner[std::size_t(count)];
    next = pair.support(-r.v);
    scale2 = std::max(scale2, next.w.squaredNorm());
    const double reach = r.v.dot(next.w), rounding = stop_share * std::sqrt(square * scale2);
    if constexpr (early) {
      if (reach > rounding) {
        r.state = GjkResult::State::separated;
        return r;
      }
    }
    bool met = square - reach <= rounding;
    for (int i = 0; i < count; ++i) met = met || corner[std::size_t(i)].w == next.w;
    if (met) break;
    solve(count + 1);
    // A corner that lies g nearer along v brings the first step only (g/|w − v|)² nearer, which rounding may hide.
    if (nearest.square < square) stalls = 0;
    else if (nearest.square > square * (1 + stop_share) || ++stalls > stall_limit) break;
    keep();
    square = std::min(square, nearest.square);
  }
  r.scale = std::sqrt(scale2);
  r.distance = r.v.norm();
  if (nearest.inside) r.state = nearest.sure ? GjkResult::State::inside : GjkResult::State::near;
  else if (square <= near_share * near_share * scale2) r.state = GjkResult::State::near;
  else r.state = GjkResult::State::apart;
  return r;
}

}  // namespace polhode
