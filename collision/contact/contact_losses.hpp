// SPDX-License-Identifier: BSD-3-Clause
// The work of an impulse at a contact, parted into what restitution takes and what friction takes; and the line on which it
// acts while it is held.
#pragma once

#include <span>

#include "collision/response.hpp"
#include "core/contact_model.hpp"

namespace polhode {

/// m/s, of the line of a held impulse: that of the mass centre of the two, or of the one that can move.
inline Vector3<double> line_velocity(const ImpulseBody& a, const ImpulseBody& b) {
  if (!(a.inverse_mass > 0) || !(b.inverse_mass > 0)) return a.inverse_mass > 0 ? a.velocity : b.velocity;
  return (b.inverse_mass * a.velocity + a.inverse_mass * b.velocity) / (a.inverse_mass + b.inverse_mass);
}

/// Books the work of the impulse between two instants that are `length` (s) apart, by the mean of the velocities of A relative
/// to B where it acts. For a jump, of length 0, that is exact. Returns the energy lost, J.
inline double book(const ImpulseContact& c, std::span<const ImpulseBody> before, std::span<const ImpulseBody> after,
                   double length, ContactLosses& losses) {
  const Vector3<double> later = c.point + length * line_velocity(before[c.a], before[c.b]);
  const Vector3<double> mean = 0.5 * (before[c.a].velocity_at(c.point) - before[c.b].velocity_at(c.point)) +
                               0.5 * (after[c.a].velocity_at(later) - after[c.b].velocity_at(later));
  const double whole = c.impulse.dot(mean), normal = c.impulse.dot(c.normal) * mean.dot(c.normal);
  losses.impact -= normal;
  losses.friction -= whole - normal;
  return -whole;
}

}  // namespace polhode
