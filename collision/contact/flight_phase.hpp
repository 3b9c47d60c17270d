// SPDX-License-Identifier: BSD-3-Clause
// The phase of a step with located impacts. It records how the last flight ended and determines the treatment of
// contacts at the start of the next flight.
#pragma once

namespace polhode::inline collision::inline contact {

/// A step alternates between impacts at an instant and a flight to the next impact. Phases and their effect:
///
/// | phase             | entered by            | restitution   | contacts held    | added penetration of held pairs |
/// |-------------------|-----------------------|---------------|------------------|---------------------------------|
/// | undisturbed       | begin_step, completed | as given      | resting contacts | 0.01 minimum_bounce_height      |
/// | impact            | impact_found          | as given      | resting contacts | allowed_penetration (*)         |
/// | unresolved_bounce | bounce_failed         | 0 (no bounce) | resting contacts | allowed_penetration (*)         |
/// | inseparable       | contact_persists      | as given      | all contacts     | allowed_penetration (*)         |
///
/// (*) If no impact was resolved at the start of the flight; otherwise 0.01 minimum_bounce_height.
/// Every phase can follow every other phase.
class FlightPhase {
 public:
  enum class Phase {
    undisturbed,        ///< the last flight reached its end
    impact,             ///< the last flight ended at a root of a guard
    unresolved_bounce,  ///< bodies did not separate after an impact: the method cannot resolve the bounce
    inseparable,        ///< bodies did not separate without an impact: they rest on each other
  };

  void begin_step() { phase_ = Phase::undisturbed; }
  void completed() { phase_ = Phase::undisturbed; }
  void impact_found() { phase_ = Phase::impact; }
  void bounce_failed() { phase_ = Phase::unresolved_bounce; }
  void contact_persists() { phase_ = Phase::inseparable; }

  /// True if impacts use the coefficient of restitution; otherwise it is 0.
  bool restitution() const { return phase_ != Phase::unresolved_bounce; }
  /// True if all contacts are held; otherwise only resting contacts are.
  bool holds_all() const { return phase_ == Phase::inseparable; }
  /// True if a guard crossed zero here but no impact was resolved: a held pair has reached its allowed penetration.
  bool sinks(bool impact_taken) const { return !impact_taken && phase_ != Phase::undisturbed; }

 private:
  Phase phase_ = Phase::undisturbed;
};

}  // namespace polhode::collision::contact
