// SPDX-License-Identifier: BSD-3-Clause
// No contact gives energy. Newton's restitution can, with friction or where contacts of an island have different ones
// (Kane, 1984; Stronge, 1990); so can a sum of impulses that is not found to the end. Then the impulses are drawn
// towards others that take energy, no further than needed: kinetic energy is a convex parabola along the way. Discs and
// cones are convex, so friction stays in them.
#pragma once

#include <span>
#include <vector>

#include "collision/response/islands.hpp"

namespace polhode::inline collision {

/// The largest s in [0, 1] at which start + s slope + s² (end − start − slope), which is `end` at 1, is at most zero;
/// start is not above zero.
double share_without_gain(double start, double slope, double end);

class EnergyGuard {
 public:
  /// Whether the impulses of an island give energy to the bodies, which have the velocities before.
  bool gains(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts);
  /// Draws the impulses of those islands towards `reference`, or towards none where that gives energy too; after
  /// gains().
  void limit(std::span<const ImpulseBody> bodies, std::span<ImpulseContact> contacts,
             std::span<const Vector3<double>> reference);

 private:
  struct Gain {
    double energy = 0;  ///< J
    double scale = 0;   ///< J, of what cancels in it
    bool rises() const { return energy > 1e-11 * scale; }
  };

  Islands islands_;
  std::vector<ImpulseBody> after_, after_reference_;
  std::vector<std::uint32_t> gaining_;
};

}  // namespace polhode
