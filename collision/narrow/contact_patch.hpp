// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of any two convex shapes, from their signed distance: whatever narrow phase found it.
//
// A face that looks along the normal is the reference; what the other shape turns towards it, a face, an edge or a
// point, is clipped by its sides (patch.hpp). Without such a face, edges that are parallel as seen along the normal
// meet in the two ends of what they share, and all else in the nearest points. Of two faces at most 0.1 rad from
// parallel the one that is further from the other shape is the reference, and the manifold's normal is its own: a body
// that rocks keeps its points. Otherwise the normal is that of the distance.
#pragma once

#include "collision/narrow_phase.hpp"

namespace polhode::inline collision {

/// Of shapes that are convex, or half-spaces; empty where they are further apart than `margin` (m). With A and B
/// exchanged, and the distance mirrored, the manifold is mirrored to the last digit. Features are numbered as
/// support_feature.hpp says; a half-space has face 0. Where the end of an edge meets an edge beside it, the feature is
/// `other`, with the highest bit set in the number of the end. Takes no memory but for a thread's first pairs.
Manifold contact_patch(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, const Distance& distance,
                       double margin);

/// Where A or B is a compound, by the manifolds that the narrow phase gives for pairs of their parts. It has the normal
/// of the deepest, and the points of all whose normals are at most 0.1 rad from it, as deep as they are along it; of
/// these, those that matter. To each feature's number its part is added, times 65536.
Manifold compound_patch(const NarrowPhase& phase, const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                        double margin);

}  // namespace polhode
