// SPDX-License-Identifier: BSD-3-Clause
// Tests whether vectors are parallel or perpendicular, within some roundings.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline core::inline math {

/// True if a is parallel to a unit vector: |a × unit| <= roundings ε |a|. True for a = 0.
inline bool is_parallel(const Vector3<double>& a, const Vector3<double>& unit, double roundings) {
  return a.cross(unit).norm() <= roundings * std::numeric_limits<double>::epsilon() * a.norm();
}

/// True if |a · b| <= roundings ε |a| |b|. True if one of them is 0.
inline bool is_perpendicular(const Vector3<double>& a, const Vector3<double>& b, double roundings) {
  return std::abs(a.dot(b)) <= roundings * std::numeric_limits<double>::epsilon() * a.norm() * b.norm();
}

}  // namespace polhode::core::math
