// SPDX-License-Identifier: BSD-3-Clause
// The exact normals that a feature of two polytopes can have: of a face of one, or perpendicular to an edge of each.
#pragma once

#include "collision/narrow/minkowski_pair.hpp"

namespace polhode::inline collision {

/// a × b with each component right to the last bits, however nearly parallel a and b are (Kahan's difference of
/// products; Jeannerod, Louvet & Muller, Mathematics of Computation 82, 2013).
Vector3<double> accurate_cross(const Vector3<double>& a, const Vector3<double>& b);

/// The outward normal of the face that looks most along d, in the core's axes. The core has faces.
Vector3<double> nearest_face_normal(const ConvexCore& core, const Vector3<double>& d);

/// The unit product of an edge of A and an edge of B, among those between three corners, that lies nearest to n; zero
/// if there is none within 0.1 rad.
Vector3<double> nearest_edge_product(const MinkowskiCorner& c0, const MinkowskiCorner& c1, const MinkowskiCorner& c2,
                                     const Vector3<double>& n);

}  // namespace polhode
