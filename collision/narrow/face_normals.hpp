// SPDX-License-Identifier: BSD-3-Clause
// Exact normals of features of two polytopes: the normal of a face, or the product of an edge of each.
#pragma once

#include "collision/narrow/minkowski_pair.hpp"

namespace polhode::inline collision::inline narrow {

/// a × b with each component exact to the last bits, however nearly parallel a and b are (Kahan's difference of
/// products; Jeannerod, Louvet & Muller, Mathematics of Computation 82, 2013).
Vector3<double> accurate_cross(const Vector3<double>& a, const Vector3<double>& b);

/// The outward normal of the face that is closest to the direction d, in the axes of the core. The core must have
/// faces.
Vector3<double> nearest_face_normal(const ConvexCore& core, const Vector3<double>& d);

/// Unit products of an edge of A and an edge of B between the three corners: the one closest to n; zero if none is
/// within 0.1 rad of it.
Vector3<double> nearest_edge_product(const MinkowskiCorner& c0, const MinkowskiCorner& c1, const MinkowskiCorner& c2,
                                     const Vector3<double>& n);

}  // namespace polhode::collision::narrow
