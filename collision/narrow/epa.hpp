// SPDX-License-Identifier: BSD-3-Clause
// EPA: how deep two convex shapes overlap, by expanding a polytope inside A ⊖ B towards the part of its surface that is
// nearest to the origin.
// Source: van den Bergen, Proximity queries and penetration depth computation on 3D game objects, GDC 2001.
#pragma once

#include "collision/narrow/gjk_loop.hpp"

namespace polhode {

/// How far the shapes are apart along n (unit, from B to A, in A's axes): min over A of n·a − max over B of n·b. For
/// every n this is at most the signed distance, and moving A by −separation along n parts the two: no n is wrong, one
/// is best.
double separation(const MinkowskiPair& pair, const Vector3<double>& n);

struct Penetration {
  double distance = 0;  ///< m, signed: minus the depth of the cores
  Vector3<double> normal = Vector3<double>::UnitX();  ///< unit, from B to A, in A's axes
  Vector3<double> on_a = Vector3<double>::Zero();     ///< witness points, each in its own axes
  Vector3<double> on_b = Vector3<double>::Zero();
};

/// `start` is a simplex that holds the origin or lies within rounding of it.
Penetration epa(const MinkowskiPair& pair, const Simplex& start);

}  // namespace polhode
