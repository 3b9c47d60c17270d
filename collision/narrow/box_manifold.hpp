// SPDX-License-Identifier: BSD-3-Clause
// The contact patch of two boxes. Vertices, edges and faces are numbered as the box's polytope has them.
#pragma once

#include "collision/narrow/box_sat.hpp"

namespace polhode::inline collision::inline narrow {

/// The contact patch; empty if the boxes are more than `margin` (m) apart. Two almost parallel faces (0.1 rad) meet as
/// faces even if an edge axis has slightly less depth. Throws std::invalid_argument if a pose is not finite.
Manifold boxes_manifold(const BoxAt& a, const BoxAt& b, double margin);

}  // namespace polhode::collision::narrow
