// SPDX-License-Identifier: BSD-3-Clause
// EPA: penetration depth of two convex shapes, by expanding a polytope inside A ⊖ B towards the part of its surface
// that is nearest to the origin.
// Source: van den Bergen, Proximity queries and penetration depth computation on 3D game objects, GDC 2001.
#pragma once

#include <optional>

#include "collision/narrow/gjk_loop.hpp"
#include "collision/narrow_phase.hpp"

namespace polhode::inline collision::inline narrow {

/// Separation along n (unit, from B to A, in A's axes): min over A of n·a − max over B of n·b. Every n gives a lower
/// bound of the signed distance; the maximum over n is the signed distance. Moving A by −separation along n separates
/// the shapes.
double separation(const MinkowskiPair& pair, const Vector3<double>& n);

struct Penetration {
  double distance = 0;                                ///< signed distance: minus the depth of the cores, m
  Vector3<double> normal = Vector3<double>::UnitX();  ///< unit normal from B to A, in A's axes
  Vector3<double> on_a = Vector3<double>::Zero();     ///< witness points, both in A's axes, relative to A's origin
  Vector3<double> on_b = Vector3<double>::Zero();
};

/// Tries the exact normals of the features of the three corners: a face of either shape, or the product of two edges.
/// If the separation along one of them is larger than p.distance, p takes that normal and that separation.
void polish(const MinkowskiPair& pair, const std::array<MinkowskiCorner, 3>& corners, Penetration& p);

/// The penetration. `start` must have ended as `inside` or `near`. If `shell` is not null, it receives the polytope for
/// epa_again().
Penetration epa(const MinkowskiPair& pair, const GjkResult& start, PairMemory::Shell* shell);

/// The penetration, starting from the polytope of the previous query. If that still contains the origin, and the
/// touching features are the same, one new corner proves the answer. Otherwise the result is empty.
std::optional<Penetration> epa_again(const MinkowskiPair& pair, PairMemory::Shell& shell);

}  // namespace polhode::collision::narrow
