// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of any two convex shapes, from their signed distance, whichever narrow phase computed it.
//
// A face whose normal is the contact normal is the reference; the feature of the other shape that faces it (face, edge
// or point) is clipped by its sides (patch.hpp). If there is no such face, edges that are parallel as seen along the
// normal meet in the two ends of their common part; all else meets in the nearest points. Of two faces at most 0.1 rad
// from parallel, the one further from the other shape is the reference, and the manifold has its normal, so that a
// rocking body keeps its contact points. Otherwise the normal is that of the distance.
#pragma once

#include "collision/narrow_phase.hpp"

namespace polhode::inline collision::inline narrow {

/// The patch of two shapes that are convex or half-spaces; empty if they are more than `margin` (m) apart. If A and B
/// are exchanged and the distance is mirrored, the manifold is mirrored to the last digit. Features are numbered as in
/// support_feature.hpp; a half-space has face 0. If the end of an edge meets an adjacent edge, the feature is `other`,
/// with the highest bit set in the number of the end. Allocates memory for the first pairs of a thread only.
Manifold contact_patch(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, const Distance& distance,
                       double margin);

/// The patch if A or B is a compound, from the manifolds of pairs of parts that the narrow phase computes. It has the
/// normal of the deepest manifold, and the points of all manifolds whose normals are at most 0.1 rad from it, with
/// their depths along it; of these points, those that determine the contact. 65536 times the number of the part is
/// added to the number of each feature.
Manifold compound_patch(const NarrowPhase& phase, const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                        double margin);

}  // namespace polhode::collision::narrow
