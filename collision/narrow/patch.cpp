// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/patch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "collision/narrow/four.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

constexpr double least_gain = 1.0 / 32;  // least gain, over the patch's area, by a point beside four others

/// The feature at which the edge that leaves a corner crosses a side: another side's edge (then it is a vertex of the
/// reference face), or an edge of the incident face.
Feature crossing(const PatchCorner& from, std::span<const PatchSide> sides, std::size_t side,
                 std::uint32_t incident_face) {
  if (!from.along_side) return {Feature::Kind::edge_edge, sides[side].edge, from.edge};
  if ((from.edge + 1) % sides.size() == side) return {Feature::Kind::vertex_face, sides[side].start, incident_face};
  if ((side + 1) % sides.size() == from.edge)
    return {Feature::Kind::vertex_face, sides[from.edge].start, incident_face};
  return {Feature::Kind::other, sides[side].edge, sides[from.edge].edge};
}

/// Squared distances of four corners, from number k on, from corner `from`.
[[gnu::always_inline]] inline Four squared_distances(const CornersInLanes& c, std::size_t from, std::size_t k) {
  const Four dx = four(c.x + k) - all(c.x[from]), dy = four(c.y + k) - all(c.y[from]);
  return dx * dx + dy * dy;
}

/// Twice the areas of the triangles that they make with corners a and b, positive where counter-clockwise.
[[gnu::always_inline]] inline Four areas(const CornersInLanes& c, std::size_t a, std::size_t b, std::size_t k) {
  return all(c.x[b] - c.x[a]) * (four(c.y + k) - all(c.y[a])) - all(c.y[b] - c.y[a]) * (four(c.x + k) - all(c.x[a]));
}
double area(const CornersInLanes& c, std::size_t a, std::size_t b, std::size_t k) {
  return (c.x[b] - c.x[a]) * (c.y[k] - c.y[a]) - (c.y[b] - c.y[a]) * (c.x[k] - c.x[a]);
}

}  // namespace

/// Values that differ by round-off count as equal, and then the first is taken: a patch at rest keeps its points.
std::size_t choose_corners(const CornersInLanes& corners, std::array<std::uint32_t, Manifold::capacity>& chosen) {
  constexpr double equal = 1e-9, none = -std::numeric_limits<double>::infinity();
  for (std::size_t k = corners.count; k % 4 != 0; ++k) {
    for (double* const numbers : {corners.x, corners.y, corners.height}) numbers[k] = numbers[0];
  }
  std::size_t count = 0;
  // Takes the next corner, which has the most of a value; four corners' values at a time.
  const auto take = [&](double scale, const auto& value) {
    Four most = all(none);
    for (std::size_t k = 0; k < corners.count; k += 4) {
      const Four number = Four{0, 1, 2, 3} + all(double(k));
      Four v;
      value(k, v);
      v = number < all(double(corners.count)) ? v : all(none);
      for (std::size_t t = 0; t < count; ++t) v = number == all(double(chosen[t])) ? all(none) : v;
      put(v, corners.scratch + k);
      most = larger(most, v);
    }
    const double enough = highest(most) - equal * scale;
    std::uint32_t first = 0;
    for (std::size_t k = 0; k < corners.count; k += 4) {
      const std::uint32_t found = bits(four(corners.scratch + k) >= all(enough));
      if (found == 0) continue;
      first = std::uint32_t(k) + std::uint32_t(std::countr_zero(found));
      break;
    }
    chosen[count++] = first;
    return corners.scratch[first];
  };
  Four furthest = squared_distances(corners, 0, 0);
  for (std::size_t k = 4; k < corners.count; k += 4) furthest = larger(furthest, squared_distances(corners, 0, k));
  const double size = highest(furthest);
  take(std::sqrt(size), [&](std::size_t k, Four& v) { v = -four(corners.height + k); });
  take(size, [&](std::size_t k, Four& v) { v = squared_distances(corners, chosen[0], k); });
  take(size, [&](std::size_t k, Four& v) { v = absolute(areas(corners, chosen[0], chosen[1], k)); });
  // The corners so far, counter-clockwise, and the side beyond which another one adds the most area.
  std::array<std::uint32_t, Manifold::capacity + 1> ring{chosen[0], chosen[1], chosen[2], chosen[0]};
  double whole = area(corners, chosen[0], chosen[1], chosen[2]);
  if (whole < 0) std::swap(ring[1], ring[2]);
  whole = std::abs(whole);
  const std::size_t most = std::min(corners.count, chosen.size());
  while (count < most) {
    const std::size_t sides = count;
    const double gain = take(size, [&](std::size_t k, Four& beyond) {
      beyond = -areas(corners, ring[0], ring[1], k);
      for (std::size_t side = 1; side < sides; ++side)
        beyond = larger(beyond, -areas(corners, ring[side], ring[side + 1], k));
    });
    if (sides >= 4 && gain <= least_gain * whole) return sides;
    const std::uint32_t added = chosen[sides];
    std::size_t best = 0;
    double beyond = -area(corners, ring[0], ring[1], added);
    for (std::size_t side = 1; side < sides; ++side) {
      const double b = -area(corners, ring[side], ring[side + 1], added);
      best = b > beyond ? side : best;
      beyond = std::max(beyond, b);
    }
    std::copy_backward(ring.begin() + std::ptrdiff_t(best) + 1, ring.begin() + std::ptrdiff_t(sides) + 1,
                       ring.begin() + std::ptrdiff_t(sides) + 2);
    ring[best + 1] = added;
    whole += std::max(gain, 0.0);
  }
  return count;
}

std::span<PatchCorner> those_that_matter(std::span<PatchCorner> corners) {
  if (corners.size() <= 4) return corners;
  const auto by_feature = [](const PatchCorner& a, const PatchCorner& b) {
    return std::tie(a.feature.kind, a.feature.of_a, a.feature.of_b) <
           std::tie(b.feature.kind, b.feature.of_a, b.feature.of_b);
  };
  std::sort(corners.begin(), corners.end(), by_feature);
  thread_local std::vector<double> numbers;
  const std::size_t room = corners.size() + 3;
  numbers.resize(4 * room);
  double* const x = numbers.data();
  const CornersInLanes lanes{x, x + room, x + 2 * room, x + 3 * room, corners.size()};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    lanes.x[k] = corners[k].x;
    lanes.y[k] = corners[k].y;
    lanes.height[k] = corners[k].height;
  }
  std::array<std::uint32_t, Manifold::capacity> chosen;
  const std::size_t count = choose_corners(lanes, chosen);
  std::array<PatchCorner, Manifold::capacity> kept;
  for (std::size_t k = 0; k < count; ++k) kept[k] = corners[chosen[k]];
  std::copy_n(kept.begin(), count, corners.begin());
  return corners.first(count);
}

std::span<PatchCorner> clip_patch(std::span<const PatchSide> sides, std::uint32_t incident_face, double tolerance,
                                  std::span<PatchCorner> corners, std::size_t count, std::span<PatchCorner> buffer) {
  std::span<PatchCorner> from = corners, to = buffer;
  for (std::size_t s = 0; s < sides.size() && count > 0; ++s) {
    const PatchSide& side = sides[s];
    const auto outside = [&](const PatchCorner& c) { return side.nx * c.x + side.ny * c.y - side.offset; };
    std::size_t made = 0;
    double here = outside(from[0]);
    for (std::size_t k = 0; k < count; ++k) {
      const PatchCorner& a = from[k];
      const PatchCorner& b = from[k + 1 == count ? 0 : k + 1];
      const double there = outside(b);
      const bool inside = here <= tolerance, next_inside = there <= tolerance;
      if (inside) to[made++] = a;
      if (inside != next_inside) {
        const double share = std::clamp(here / (here - there), 0.0, 1.0);
        PatchCorner cut = a;
        cut.x += share * (b.x - a.x);
        cut.y += share * (b.y - a.y);
        cut.height += share * (b.height - a.height);
        cut.feature = crossing(a, sides, s, incident_face);
        if (inside) {
          cut.along_side = true;
          cut.edge = static_cast<std::uint32_t>(s);
        }
        to[made++] = cut;
      }
      here = there;
    }
    count = made;
    std::swap(from, to);
  }
  return from.first(count);
}

void take_patch(const PatchFrame& frame, std::span<PatchCorner> corners, Manifold& manifold) {
  const auto left = those_that_matter(corners);
  manifold.count = left.size();
  for (std::size_t k = 0; k < left.size(); ++k) {
    const PatchCorner& c = left[k];
    manifold.points[k] = {frame.to_world(c.x, c.y, 0.5 * c.height), -c.height, c.feature};
  }
}

void mirror(Manifold& manifold) {
  manifold.normal = -manifold.normal;
  for (std::size_t k = 0; k < manifold.count; ++k) {
    Feature& f = manifold.points[k].feature;
    std::swap(f.of_a, f.of_b);
    f.kind = f.kind == Feature::Kind::vertex_face   ? Feature::Kind::face_vertex
             : f.kind == Feature::Kind::face_vertex ? Feature::Kind::vertex_face
                                                    : f.kind;
  }
}

}  // namespace polhode::collision::narrow
