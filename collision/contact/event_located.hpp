// SPDX-License-Identifier: BSD-3-Clause
// Contact model with located events. Between impacts the method integrates the free flight of the bodies. An impact is
// the root of a signed distance. A method with native event location (CVODE) ends its step at the root. Otherwise
// TOMS 748 (Alefeld, Potra & Shi, Algorithm 748, 1995) brackets the root, on the dense output of the method if it has
// one, else over repeated steps from the start of the flight. The flight therefore has the order of the method, and the
// error of the event time decreases accordingly.
//
// Simultaneous impacts: the response resolves all impacts of one instant together.
// Missed roots: if the bounds of guards.hpp allow a distance to be negative between two evaluations, the interval is
// halved until it is shorter than 1e-6 of the step.
// Zeno sequences: a bounce lower than the minimum bounce height (1e-11 of the largest body), or one that the method
// cannot resolve, is not simulated. The contact then rests.
// Resting contacts: the response computes impulses that hold the contact during the step, as in time stepping. The hold
// ends when a pair stops sliding. That time is the root of the remaining slip, found by TOMS 748 over repeated holds.
// Penetration: a held pair may penetrate by 1e-7 of the largest body before it counts as an impact again.
// Limit: after 1000 impacts in one step the run fails with a message. This occurs with the response single_impulse when
// a body settles on a face: with one impulse per pair the body rocks from side to side with increasing frequency, and
// no contact point comes to rest before the others.
#pragma once

#include "collision/contact/constant_contact_forces.hpp"
#include "collision/contact/contact_kinematics.hpp"
#include "collision/contact/contact_scene.hpp"
#include "collision/contact/flight_phase.hpp"
#include "collision/contact/guards.hpp"
#include "collision/contact/impact_search.hpp"
#include "collision/contact/resting_contacts.hpp"
#include "core/run/contact_model.hpp"

namespace polhode::inline collision::inline contact {

/// The contact model with located events.
class EventLocated final : public ContactModel {
 public:
  /// Adds the constant contact forces to the system. System and scene must outlive this object.
  EventLocated(System<double>& system, ContactScene& scene, std::unique_ptr<Response> response);

  void begin(Integrator<double>& method, const State<double>& state) override;
  StepResult step(Integrator<double>& method, State<double>& state, double h) override;
  const ContactLosses& losses() const override { return losses_; }
  std::span<const Impact> impacts() const override { return impacts_; }
  std::span<const Transition> transitions() const override { return transitions_; }

 private:
  struct Flight {
    double length = 0;    ///< duration, s
    bool impact = false;  ///< true: the flight ends with an impact
  };

  std::span<ImpulseContact> touching(const State<double>& state);
  bool take_impacts(Integrator<double>& method, State<double>& state);
  StepResult fly(Integrator<double>& method, State<double>& state, double h, bool sinks, Flight& flight);
  void watch_ahead(const State<double>& state, double h, double deeper);

  System<double>& system_;
  std::unique_ptr<Response> response_;
  ConstantContactForces* contact_forces_;
  ContactLosses losses_;
  std::vector<Impact> impacts_;
  std::vector<Transition> transitions_;
  ContactLengths lengths_;
  Guards guards_;
  ContactKinematics kinematics_;
  RestingContacts resting_;
  ImpactSearch search_;
  FlightPhase phase_;
  std::vector<ImpulseBody> after_impacts_;
  std::vector<double> rests_from_;
  VectorX<double> rate_;
  State<double> ahead_, start_, at_impact_, step_start_, before_impacts_;
};

}  // namespace polhode::collision::contact
