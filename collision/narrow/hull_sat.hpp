// SPDX-License-Identifier: BSD-3-Clause
// Separating axes of convex polytopes, and of points and segments with a radius: hulls, boxes, spheres and capsules.
// Axes are the face normals of both shapes and the products of those edges whose arcs cross on the Gauss map; these are
// the face normals of the Minkowski difference.
// Source: Gregorius, The separating axis test between convex polyhedra, Game Developers Conference 2013.
//
// The depth is the true minimum over the axes; none is preferred. Both solids are projected completely on each axis, so
// that a superfluous axis does no harm and the pruning can be generous. The largest separation is only a lower bound of
// the distance; for shapes that are apart, the distance is that of the nearest vertices, edges and faces, among those
// that the bound leaves.
#pragma once

#include "collision/contact.hpp"
#include "collision/shape.hpp"

namespace polhode::inline collision::inline narrow {

/// True for spheres, capsules, boxes and hulls.
bool has_separating_axes(const Shape& shape);

/// Signed distance of two such shapes. A against B mirrors B against A exactly if `exchanged` (pair_order.hpp)
/// distinguishes them. Throws std::invalid_argument if a pose is not finite.
Distance hulls_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b);

/// Signed distance of a half-space and a finite convex shape; the normal points out of the half-space.
Distance above_half_space(const Shape& a, const Pose& at_a, const Shape& half_space, const Pose& at_half_space);

}  // namespace polhode::collision::narrow
