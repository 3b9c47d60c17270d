// SPDX-License-Identifier: BSD-3-Clause
// GJK: the point of A ⊖ B nearest to the origin, by simplices of its corners.
// Sources: Gilbert, Johnson & Keerthi, IEEE Journal of Robotics and Automation 4(2), 1988; the sub-algorithm of
// Montanari et al. 2017 (simplex.hpp); the stop where a corner comes back, van den Bergen, Journal of Graphics Tools
// 4(2), 1999.
#pragma once

#include <algorithm>
#include <limits>

#include "collision/narrow/simplex.hpp"

namespace polhode::inline collision::inline narrow {

struct GjkResult {
  enum class State {
    apart,      ///< v is the nearest point
    separated,  ///< a separating direction was found; for queries of overlap only
    near,       ///< the origin is in the difference, or so close to its surface that rounding hides on which side
    inside,     ///< the origin is within a tetrahedron of the difference, by more than round-off
  };
  State state = State::near;
  Vector3<double> v = Vector3<double>::Zero();
  double distance = 0;  ///< |v|
  double gap = 0;  ///< difference between |v| and the lower bound of the distance along v, if it is more than round-off
  double scale = 0;  ///< the largest number in a corner, which round-off is relative to
  int steps = 0;     ///< number of corners added
  Simplex simplex;
};

/// Round-off relative to the largest number of a corner: below `near_share` of it the sign of a distance is not
/// reliable.
inline constexpr double near_share = 1e-13;
inline constexpr double stop_share = 16 * std::numeric_limits<double>::epsilon();
inline constexpr double sure_share =
    4 * stop_share;  ///< a gap between the bounds that is wider than this is more than round-off
inline constexpr int gjk_limit = 100, stall_limit = 10;

/// Starts from the simplex in `r`, which may be empty. With `early` it stops at the first direction along which the
/// shapes, including the radii around their cores, are apart.
template <bool early>
void gjk_loop(const MinkowskiPair& pair, GjkResult& r) {
  NearestPoint nearest;
  Simplex& s = r.simplex;
  double scale2 = pair.offset.squaredNorm();  // square of the largest number in a corner
  const double radius = early ? pair.radius() : 0;
  const auto separates = [&](double reach, double square) {
    if (!(reach > 0)) return false;
    const double rounding = stop_share * stop_share * scale2;
    if (radius == 0) return reach * reach > rounding * square;
    return reach > std::sqrt(square) * (radius + std::sqrt(rounding));
  };
  if (s.used == 0) {
    // Starts from the point of the difference given by the origins of the two shapes.
    const Vector3<double> first = scale2 > 0 ? Vector3<double>(-pair.offset) : Vector3<double>(-1, 0, 0);
    const Vector3<double>& w = s.corners[0].w;
    pair.support_against(first, s.corners[0]);
    scale2 = std::max(scale2, w.squaredNorm());
    if constexpr (early) {
      if (separates(first.dot(w), first.squaredNorm())) {
        r.state = GjkResult::State::separated;
        return;
      }
    }
    s.used = 1;
    SignedVolumes(nearest, s.weight).point(w, 0);
  } else {
    for (unsigned left = s.used; left != 0; left &= left - 1) {
      scale2 = std::max(scale2, s.corners[std::size_t(std::countr_zero(left))].w.squaredNorm());
    }
    solve(s, unsigned(std::bit_width(s.used)) - 1, nearest);
    s.used = nearest.used;
  }
  double square = nearest.square, gap = 0;
  int stalls = 0;

  for (int k = 0; !nearest.inside && k < gjk_limit; ++k) {
    if (square <= near_share * near_share * scale2) break;
    const auto newest = unsigned(std::countr_one(s.used));
    MinkowskiCorner& next = s.corners[newest];
    pair.support_against(nearest.v, next);
    scale2 = std::max(scale2, next.w.squaredNorm());
    const double reach = nearest.v.dot(next.w);
    gap = square - reach;
    const double rounding = stop_share * stop_share * square * scale2;  // its square
    if constexpr (early) {
      if (separates(reach, square)) {
        r.state = GjkResult::State::separated;
        return;
      }
    }
    bool met = gap <= 0 || gap * gap <= rounding;
    for (unsigned left = s.used; left != 0; left &= left - 1)
      met |= s.corners[std::size_t(std::countr_zero(left))] == next;
    if (met) break;
    const unsigned before = s.used;
    s.used |= 1u << newest;
    ++r.steps;
    solve(s, newest, nearest);
    // A corner that lies g nearer along v brings the first step only (g/|w − v|)² nearer, which rounding may hide.
    if (nearest.square < square) {
      stalls = 0;
    } else if (nearest.square > square * (1 + stop_share) || ++stalls > stall_limit) {
      s.used = before;
      solve(s, unsigned(std::bit_width(before)) - 1, nearest);
      break;
    }
    s.used = nearest.used;
    square = std::min(square, nearest.square);
  }
  r.v = nearest.v;
  r.distance = r.v.norm();
  if (gap * gap > sure_share * sure_share * square * scale2) {
    r.gap = gap / r.distance;
    r.scale = std::sqrt(scale2);
  }
  if (nearest.inside) r.state = nearest.sure ? GjkResult::State::inside : GjkResult::State::near;
  else if (square <= near_share * near_share * scale2) r.state = GjkResult::State::near;
  else r.state = GjkResult::State::apart;
}

}  // namespace polhode::collision::narrow
