// SPDX-License-Identifier: BSD-3-Clause
// Contacts that rest or slide during a flight, the impulses that hold them, and the duration for which the impulses are
// valid. The hold ends at the latest when the first pair stops sliding.
#pragma once

#include <span>
#include <vector>

#include "collision/contact/constant_contact_forces.hpp"
#include "collision/contact/contact_kinematics.hpp"
#include "collision/contact/sliding_pairs.hpp"

namespace polhode::inline collision::inline contact {

/// Resting and sliding contacts of a run.
class RestingContacts {
 public:
  /// All arguments must outlive this object.
  RestingContacts(const System<double>& system, Response& response, ConstantContactForces& contact_forces,
                  const ContactLengths& lengths)
      : system_(system), response_(response), contact_forces_(contact_forces), lengths_(lengths) {}

  /// Starts a run, in which no pair sticks yet.
  void begin() { slides_.clear(); }

  /// Holds the resting and sliding contacts among `touching` for h (s), or until the first pair stops sliding. `all`
  /// holds every contact independent of its speed. False if no contact rests or the method fails; then nothing is held.
  bool hold(Integrator<double>& method, const State<double>& state, double h, std::span<ImpulseContact> touching,
            ContactKinematics& kinematics, bool all);

  /// The contacts that hold() found, sorted by pairs; valid even if the method failed.
  std::span<const ImpulseContact> contacts() const { return hold_.contacts; }
  /// Duration of the hold, s.
  double length() const { return hold_.length; }

  /// Appends the pairs that stop sliding at the end of the hold, time t (s).
  void note_transitions(double t, std::vector<Transition>& transitions) const {
    slides_.note_transitions(hold_, t, transitions);
  }
  /// Records that an impact ended the hold: afterwards no pair sticks.
  void impact() { slides_.clear(); }

  /// Adds the work of the holding impulses between these two states of a flight to the losses (J). The flight may end
  /// before the hold. Moves the points of transitions at the end of the flight along with their pairs.
  void account(const State<double>& start, const State<double>& end, ContactLosses& losses,
               std::span<Transition> transitions);

 private:
  bool resolve(Integrator<double>& method, const State<double>& state, double h);
  double first_slide_end(Integrator<double>& method, const State<double>& state, double h);

  const System<double>& system_;
  Response& response_;
  ConstantContactForces& contact_forces_;
  const ContactLengths& lengths_;
  ContactHold hold_;
  SlidingPairs slides_;
  std::vector<ImpulseContact> rested_;  ///< contacts of the previous hold
  State<double> free_;                  ///< state at the end of the hold without the impulses
  std::vector<ImpulseBody> bodies_, later_;
};

}  // namespace polhode::collision::contact
