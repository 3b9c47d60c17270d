// SPDX-License-Identifier: BSD-3-Clause
// The axes of a contact, and its compliance to an impulse.
#pragma once

#include "collision/response.hpp"

namespace polhode::inline collision::inline response {

struct ContactFrame {
  Vector3<double> normal, tangent, bitangent;
};

/// Right-handed axes. A zero or invalid normal gives zeros: such a contact has no effect.
inline ContactFrame contact_frame(const Vector3<double>& normal) {
  const double length = normal.norm();
  if (!(length > 0.5 && length < 2)) return {Vector3<double>::Zero(), Vector3<double>::Zero(), Vector3<double>::Zero()};
  const Vector3<double> n = normal / length, t = n.unitOrthogonal();
  return {n, t, n.cross(t)};
}

/// The change of the relative velocity of A and B at a point by an impulse there, K j.
inline Vector3<double> mobility_along(const ImpulseBody& a, const ImpulseBody& b, const Vector3<double>& point,
                                      const Vector3<double>& impulse) {
  const Vector3<double> ra = point - a.position, rb = point - b.position;
  return (a.inverse_mass + b.inverse_mass) * impulse + (a.inverse_inertia * ra.cross(impulse)).cross(ra) +
         (b.inverse_inertia * rb.cross(impulse)).cross(rb);
}

}  // namespace polhode::collision::response
