// SPDX-License-Identifier: BSD-3-Clause
// The work of an impulse at a contact, parted into what restitution takes and what friction takes; and the line on
// which it acts while it is held.
#pragma once

#include <span>

#include "collision/response.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision {

/// Of A's position in the point that the line of a held impulse goes with: the mass centre of the two, or that which
/// can move.
inline double line_share(const ImpulseBody& a, const ImpulseBody& b) {
  if (!(a.inverse_mass > 0) || !(b.inverse_mass > 0)) return a.inverse_mass > 0 ? 1 : 0;
  return b.inverse_mass / (a.inverse_mass + b.inverse_mass);
}

/// m: how far that line has gone.
inline Vector3<double> line_shift(std::size_t a, std::size_t b, std::span<const ImpulseBody> before,
                                  std::span<const ImpulseBody> after) {
  const double share = line_share(before[a], before[b]);
  return share * (after[a].position - before[a].position) + (1 - share) * (after[b].position - before[b].position);
}

/// Books the work of the impulse between two instants by the mean of the velocities of A relative to B where it acts.
/// For a jump, between which nothing moves, that is exact. Returns the energy lost, J.
inline double book(const ImpulseContact& c, std::span<const ImpulseBody> before, std::span<const ImpulseBody> after,
                   ContactLosses& losses) {
  const Vector3<double> later = c.point + line_shift(c.a, c.b, before, after);
  const Vector3<double> mean = 0.5 * (before[c.a].velocity_at(c.point) - before[c.b].velocity_at(c.point)) +
                               0.5 * (after[c.a].velocity_at(later) - after[c.b].velocity_at(later));
  const double whole = c.impulse.dot(mean), normal = c.impulse.dot(c.normal) * mean.dot(c.normal);
  losses.impact -= normal;
  losses.friction -= whole - normal;
  return -whole;
}

}  // namespace polhode
