// SPDX-License-Identifier: BSD-3-Clause
// Contacts must not add energy. Newton's restitution can do so, with friction or if contacts of an island have
// different coefficients (Kane, 1984; Stronge, 1990); so can impulses from an iteration that was stopped early. The
// impulses are then moved towards others that dissipate energy, no further than necessary: kinetic energy is a convex
// parabola along the way. Discs and cones are convex, so friction stays within them.
#pragma once

#include <span>
#include <vector>

#include "collision/response/islands.hpp"

namespace polhode::inline collision::inline response {

/// The largest s in [0, 1] with start + s slope + s² (end − start − slope) <= 0, a parabola that is `end` at s = 1;
/// start must not be positive.
double share_without_gain(double start, double slope, double end);

class EnergyGuard {
 public:
  /// True if the impulses of some island add energy to the bodies, which have the velocities before the impulses.
  bool gains(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts);
  /// Moves the impulses of those islands towards `reference`, or towards zero if that adds energy too. Call after
  /// gains().
  void limit(std::span<const ImpulseBody> bodies, std::span<ImpulseContact> contacts,
             std::span<const Vector3<double>> reference);

 private:
  struct Gain {
    double energy = 0;  ///< J
    double scale = 0;   ///< magnitude of the terms that cancel in the energy, J
    bool rises() const { return energy > 1e-11 * scale; }
  };

  Islands islands_;
  std::vector<ImpulseBody> after_, after_reference_;
  std::vector<std::uint32_t> gaining_;
};

}  // namespace polhode::collision::response
