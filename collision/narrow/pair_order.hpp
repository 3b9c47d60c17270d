// SPDX-License-Identifier: BSD-3-Clause
// One order of two placed shapes, so that A against B and B against A are the same computation and mirror each other to
// the last digit.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision::inline narrow {

bool exchanged_at_equal_x(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b);

/// True if B goes first. Only equal shapes at equal poses have no order.
inline bool exchanged(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  const double here = at_a.position[0], there = at_b.position[0];
  return here == there ? exchanged_at_equal_x(a, at_a, b, at_b) : here > there;
}

}  // namespace polhode::collision::narrow
