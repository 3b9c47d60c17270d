// SPDX-License-Identifier: BSD-3-Clause
// Shape and surface of a body in contact.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision::inline contact {

/// Shape and surface properties of a body; a body without a shape touches nothing.
struct Collider {
  ShapePointer shape;
  double restitution = 0;  ///< Newton's; a pair has the larger of its two
  double friction = 0;     ///< Coulomb's; a pair has the geometric mean of its two
};

}  // namespace polhode::collision::contact
