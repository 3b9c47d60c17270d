// SPDX-License-Identifier: BSD-3-Clause
// One order of two placed shapes, so that A against B and B against A are one computation, and mirror each other to the
// last digit.
#pragma once

#include "collision/shape.hpp"

namespace polhode {

/// True if B goes first. Only shapes that are the same, at the same pose, have no order.
bool exchanged(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b);

}  // namespace polhode
