// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace polhode {
namespace {

constexpr double least_gain = 1.0 / 32;  // of the patch's area, for a point beside four others to matter

/// Where the edge that leaves a corner meets a side: another side's edge (then it is a vertex of the reference face), or an
/// edge of the incident face.
Feature crossing(const PatchCorner& from, std::span<const PatchSide> sides, std::size_t side, std::uint32_t incident_face) {
  if (!from.along_side) return {Feature::Kind::edge_edge, sides[side].edge, from.edge};
  if ((from.edge + 1) % sides.size() == side) return {Feature::Kind::vertex_face, sides[side].start, incident_face};
  if ((side + 1) % sides.size() == from.edge) return {Feature::Kind::vertex_face, sides[from.edge].start, incident_face};
  return {Feature::Kind::other, sides[side].edge, sides[from.edge].edge};
}

double area(const PatchCorner& a, const PatchCorner& b, const PatchCorner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double squared_distance(const PatchCorner& a, const PatchCorner& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Moves the corners that matter to the front, and returns how many they are. Values that differ by round-off count as
/// equal, and then the first feature is taken: a patch at rest keeps its points.
std::size_t reduce(std::span<PatchCorner> corners) {
  constexpr double equal = 1e-9;
  const auto by_feature = [](const PatchCorner& a, const PatchCorner& b) {
    return std::tie(a.feature.kind, a.feature.of_a, a.feature.of_b) < std::tie(b.feature.kind, b.feature.of_a, b.feature.of_b);
  };
  std::sort(corners.begin(), corners.end(), by_feature);
  double size = 0;
  for (const PatchCorner& c : corners) size = std::max(size, squared_distance(c, corners[0]));
  const auto bring = [&](std::size_t place, double scale, const auto& value) {
    std::size_t best = place;
    double most = value(corners[place]);
    for (std::size_t k = place + 1; k < corners.size(); ++k) {
      const double v = value(corners[k]);
      if (v <= most + equal * scale) continue;
      most = v;
      best = k;
    }
    std::rotate(corners.begin() + std::ptrdiff_t(place), corners.begin() + std::ptrdiff_t(best),
                corners.begin() + std::ptrdiff_t(best) + 1);
    return most;
  };
  bring(0, std::sqrt(size), [](const PatchCorner& c) { return -c.height; });
  bring(1, size, [&](const PatchCorner& c) { return squared_distance(c, corners[0]); });
  bring(2, size, [&](const PatchCorner& c) { return std::abs(area(corners[0], corners[1], c)); });
  // The corners so far, counter-clockwise, and the side beyond which another one adds the most area.
  std::array<std::size_t, Manifold::capacity> ring{0, 1, 2};
  if (area(corners[0], corners[1], corners[2]) < 0) std::swap(ring[1], ring[2]);
  double whole = std::abs(area(corners[0], corners[1], corners[2]));
  std::size_t count = 3;
  for (; count < std::min(corners.size(), ring.size()); ++count) {
    const auto beyond = [&](std::size_t side, const PatchCorner& c) {
      return -area(corners[ring[side]], corners[ring[side + 1 == count ? 0 : side + 1]], c);
    };
    const double gain = bring(count, size, [&](const PatchCorner& c) {
      double most = beyond(0, c);
      for (std::size_t side = 1; side < count; ++side) most = std::max(most, beyond(side, c));
      return most;
    });
    if (count >= 4 && gain <= least_gain * whole) break;
    std::size_t best = 0;
    for (std::size_t side = 1; side < count; ++side) {
      if (beyond(side, corners[count]) > beyond(best, corners[count])) best = side;
    }
    std::copy_backward(ring.begin() + std::ptrdiff_t(best) + 1, ring.begin() + std::ptrdiff_t(count),
                       ring.begin() + std::ptrdiff_t(count) + 1);
    ring[best + 1] = count;
    whole += std::max(gain, 0.0);
  }
  return count;
}

}  // namespace

std::span<PatchCorner> those_that_matter(std::span<PatchCorner> corners) {
  return corners.size() > 4 ? corners.first(reduce(corners)) : corners;
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

void take_patch(const PatchFrame& frame, std::span<PatchCorner> corners, double highest, Manifold& manifold) {
  const auto end = std::remove_if(corners.begin(), corners.end(), [&](const PatchCorner& c) { return c.height > highest; });
  const auto left = those_that_matter({corners.begin(), end});
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

}  // namespace polhode
