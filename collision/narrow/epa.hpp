// SPDX-License-Identifier: BSD-3-Clause
// EPA: how deep two convex shapes overlap, by expanding a polytope inside A ⊖ B towards the part of its surface that is
// nearest to the origin.
// Source: van den Bergen, Proximity queries and penetration depth computation on 3D game objects, GDC 2001.
#pragma once

#include <optional>

#include "collision/narrow/gjk_loop.hpp"
#include "collision/narrow_phase.hpp"

namespace polhode::inline collision {

/// How far the shapes are apart along n (unit, from B to A, in A's axes): min over A of n·a − max over B of n·b. For
/// every n this is at most the signed distance, and moving A by −separation along n parts the two: no n is wrong, one
/// is best.
double separation(const MinkowskiPair& pair, const Vector3<double>& n);

struct Penetration {
  double distance = 0;                                ///< m, signed: minus the depth of the cores
  Vector3<double> normal = Vector3<double>::UnitX();  ///< unit, from B to A, in A's axes
  Vector3<double> on_a = Vector3<double>::Zero();     ///< witness points, both in A's axes about A's origin
  Vector3<double> on_b = Vector3<double>::Zero();
};

/// What touches are features of the shapes, whose normal they know to the last digit: a face of either, or the product
/// of two edges between the corners. Takes the normal and its separation where that is larger than p.distance.
void polish(const MinkowskiPair& pair, const std::array<MinkowskiCorner, 3>& corners, Penetration& p);

/// `start` says `inside` or `near`. What is left in `shell`, unless that is null,
/// serves `epa_again`.
Penetration epa(const MinkowskiPair& pair, const GjkResult& start, PairMemory::Shell* shell);

/// The same, from what the last answer left. Where that still holds the origin one corner proves the answer, as long as
/// the features that touch are the same. Nothing where it does not.
std::optional<Penetration> epa_again(const MinkowskiPair& pair, PairMemory::Shell& shell);

}  // namespace polhode
