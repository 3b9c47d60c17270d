// SPDX-License-Identifier: BSD-3-Clause
// Separating axes of convex polytopes, and of what is a point or a segment with a ball rolled around it: hulls, boxes,
// spheres and capsules. Axes are the face normals of both and the products of those edges whose arcs cross on the Gauss
// map, which are the faces of the Minkowski difference.
// Source: Gregorius, The separating axis test between convex polyhedra, Game Developers Conference 2013.
//
// The depth is the true minimum over the axes, none preferred. Of any axis both solids are projected with all that they
// have, so that an axis too many does no harm, and the pruning can be generous. The largest separation is only a lower
// bound of the distance; apart, the distance is that of the nearest vertices, edges and faces, looked for among those
// that the bound leaves.
#pragma once

#include "collision/contact.hpp"
#include "collision/shape.hpp"

namespace polhode::inline collision {

/// True for spheres, capsules, boxes and hulls.
bool has_separating_axes(const Shape& shape);

/// Signed distance of two such shapes. A against B mirrors B against A exactly where `exchanged` (pair_order.hpp) tells
/// them apart. Throws std::invalid_argument if a pose is not finite.
Distance hulls_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b);

/// A half-space and a finite convex shape: the normal points out of the half-space.
Distance above_half_space(const Shape& a, const Pose& at_a, const Shape& half_space, const Pose& at_half_space);

}  // namespace polhode
