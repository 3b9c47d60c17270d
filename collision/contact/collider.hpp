// SPDX-License-Identifier: BSD-3-Clause
// What of a body can touch.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision {

/// The shape of a body and its surface; without a shape the body touches nothing.
struct Collider {
  ShapePointer shape;
  double restitution = 0;  ///< Newton's, of a pair the larger
  double friction = 0;     ///< Coulomb's, of a pair the geometric mean
};

}  // namespace polhode
