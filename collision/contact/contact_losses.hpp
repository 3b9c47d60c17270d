// SPDX-License-Identifier: BSD-3-Clause
// Splits the work of an impulse at a contact into the parts of restitution and of friction, and tracks the line of
// action of an impulse that acts as a constant force.
#pragma once

#include <span>

#include "collision/response.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision::inline contact {

/// Weight of A in the point that moves with the line of action of a constant contact force: the common mass centre of
/// the two bodies, or the body that can move.
inline double line_share(const ImpulseBody& a, const ImpulseBody& b) {
  if (!(a.inverse_mass > 0) || !(b.inverse_mass > 0)) return a.inverse_mass > 0 ? 1 : 0;
  return b.inverse_mass / (a.inverse_mass + b.inverse_mass);
}

/// Displacement (m) of the line of action since the start of the step.
inline Vector3<double> line_shift(std::size_t a, std::size_t b, std::span<const ImpulseBody> before,
                                  std::span<const ImpulseBody> after) {
  const double share = line_share(before[a], before[b]);
  return share * (after[a].position - before[a].position) + (1 - share) * (after[b].position - before[b].position);
}

/// Adds the work of the impulse between two instants to the losses, by the mean of the relative velocities of A and B
/// at the two instants. This is exact for a jump, during which nothing moves. Returns the energy lost (J).
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

}  // namespace polhode::collision::contact
